#include "kestrel/lab/conditions.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(Conditions, ReadModifiersByTheirWords) {
  EXPECT_EQ(modified({}, "kz0.5").depth_factor, 0.5);
  EXPECT_EQ(modified({}, "f1.2").focal_factor, 1.2);
  EXPECT_EQ(modified({}, "u20").principal_u_px, 20);
  EXPECT_EQ(modified({}, "v-5").principal_v_px, -5);
  EXPECT_EQ(modified({}, "model").desired, Conditions::Desired::Model);
  EXPECT_EQ(modified({}, "d3").delay_frames, 3);
  EXPECT_EQ(modified({}, "r60").rate_hz, 60);
  EXPECT_TRUE(modified({}, "sat").limits);
  EXPECT_FALSE(modified({}, "").limits);
  const Conditions both = modified({}, "d3_l8");
  EXPECT_EQ(both.delay_frames, 3);
  EXPECT_EQ(both.gain_per_s, 8);
  const Conditions noisy = modified({}, "n0.5");
  EXPECT_EQ(noisy.noise_px, 0.5);
  EXPECT_EQ(noisy.steps, 900);
}

TEST(Conditions, RejectWordsTheyDoNotKnow) {
  for (const char* modifier : {"x2", "kz", "kzx", "kz2x", "d1.5", "kz2__d1", "n-1", "kz0", "d-1",
                               "kznan", "l1e400", "saturated", "2"}) {
    EXPECT_THROW(modified({}, modifier), std::invalid_argument) << modifier;
  }
}

TEST(Conditions, CheckNamesWhatIsOutOfRange) {
  const auto fault = [](const Conditions& c) -> std::string {
    try {
      c.check();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault({}), "");
  Conditions c;
  c.rate_hz = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(fault(c).find("rate_hz"), std::string::npos);
  c = {};
  c.steps = 0;
  EXPECT_NE(fault(c).find("steps"), std::string::npos);
  c = {};
  c.limits = CameraLimits{1, 0};
  EXPECT_NE(fault(c).find("limits.angular_rad_s"), std::string::npos);
}

}  // namespace
}  // namespace kestrel
