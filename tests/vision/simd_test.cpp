#include "kestrel/vision/simd.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(Simd, BaselineNeverRunsWithAvx2) { EXPECT_FALSE(use_avx2(Simd::Baseline)); }

TEST(Simd, AutoAsksTheProcessor) {
  EXPECT_EQ(use_avx2(Simd::Auto), __builtin_cpu_supports("avx2") != 0);
}

}  // namespace
}  // namespace kestrel
