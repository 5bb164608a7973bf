#include "kestrel/vision/simd.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(Simd, BaselineIsNeverAvx2) { EXPECT_FALSE(use_avx2(Simd::Baseline)); }

}  // namespace
}  // namespace kestrel
