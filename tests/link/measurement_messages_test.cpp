#include "kestrel/link/measurement_messages.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;

TEST(MeasurementMessages, PutFieldsWhereTheStandardDoes) {
  Odometry odometry;
  odometry.q = {1, 0, 0, 0};
  odometry.velocity_covariance[20] = 1;
  odometry.quality = -1;
  const Buffer wire = test::fields(odometry);
  EXPECT_EQ(wire[23], 0x3F);  // of 1.0F
  EXPECT_EQ(wire[227], 0x3F);
  EXPECT_EQ(wire[232], 0xFF);
  LandingTarget target;
  target.position_valid = 1;
  EXPECT_EQ(test::fields(target)[59], 1);
}

}  // namespace
}  // namespace kestrel::mavlink
