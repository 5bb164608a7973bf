#include "kestrel/vision/affine_pair.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(AffinePair, SaysNothingOfScaleAngleAndDistinctionUnlessTold) {
  const AffinePair pair;
  EXPECT_EQ(pair.image_from_template, Eigen::Matrix2f::Identity());
  EXPECT_EQ(pair.ratio, 1);  // the nearest is no nearer than the second nearest
}

}  // namespace
}  // namespace kestrel
