#include "kestrel/link/setpoint.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// The float of the wire is within half a unit in its last place of 24 bits.
constexpr double kFloatRounding = 0x1p-24;

VelocityCommand command_from(test::Random& random) {
  return {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3),
          random.uniform(-1, 1)};
}

TEST(Setpoint, RoundTripsToTheFloatOfTheWire) {
  test::Random random("setpoint");
  for (int i = 0; i < 500; ++i) {
    const VelocityCommand command = command_from(random);
    const auto back = velocity_of(velocity_setpoint(command, 5, {}));
    ASSERT_TRUE(back);
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(back->vector()[k], command.vector()[k],
                  kFloatRounding * std::abs(command.vector()[k]));
    }
  }
}

TEST(Setpoint, HasEachVelocityInItsField) {
  const auto s = velocity_setpoint({1, 2, 3, 4}, 77, {9, 8});
  EXPECT_EQ(s.vx_m_s, 1);
  EXPECT_EQ(s.vy_m_s, 2);
  EXPECT_EQ(s.vz_m_s, 3);
  EXPECT_EQ(s.yaw_rate_rad_s, 4);
  EXPECT_EQ(s.time_boot_ms, 77u);
  EXPECT_EQ(s.target_system, 9);
  EXPECT_EQ(s.target_component, 8);
  EXPECT_EQ(s.coordinate_frame, 8);  // MAV_FRAME_BODY_NED
}

// POSITION_TARGET_TYPEMASK of the standard: a bit set is a field ignored.
TEST(Setpoint, AsksForVelocityAndYawRateAlone) {
  const unsigned mask = velocity_setpoint({}, 0, {}).type_mask;
  const unsigned position = 1 | 2 | 4, velocity = 8 | 16 | 32, acceleration = 64 | 128 | 256;
  const unsigned force = 512, yaw = 1024, yaw_rate = 2048;
  EXPECT_EQ(mask, position | acceleration | yaw);
  EXPECT_EQ(mask & (velocity | yaw_rate | force), 0u);
}

TEST(Setpoint, OfANumberThatIsNotFiniteIsHover) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e39, -1e300}) {
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector4d v(1, 2, 3, 0.5);
      v[k] = bad;
      const VelocityCommand command = VelocityCommand::from_vector(v);
      EXPECT_FALSE(is_sendable(command));
      const auto back = velocity_of(velocity_setpoint(command, 0, {}));
      ASSERT_TRUE(back);
      EXPECT_EQ(back->vector(), Eigen::Vector4d::Zero());
    }
  }
}

TEST(Setpoint, HoldsNoDenormals) {
  const double smallest = std::numeric_limits<float>::min();
  const auto s = velocity_setpoint({smallest / 2, -smallest / 2, smallest, 1e-300}, 0, {});
  EXPECT_EQ(test::bits_of(s.vx_m_s), 0u);
  EXPECT_EQ(test::bits_of(s.vy_m_s), 0u);
  EXPECT_EQ(s.vz_m_s, std::numeric_limits<float>::min());
  EXPECT_EQ(test::bits_of(s.yaw_rate_rad_s), 0u);
  EXPECT_TRUE(is_sendable({std::numeric_limits<float>::max(), 0, 0, 0}));
}

TEST(Setpoint, WithAnyFloatNotFiniteIsNoVelocity) {
  using S = mavlink::SetPositionTarget;
  for (float S::*member :
       {&S::x_m, &S::y_m, &S::z_m, &S::vx_m_s, &S::vy_m_s, &S::vz_m_s, &S::ax_m_s2, &S::ay_m_s2,
        &S::az_m_s2, &S::yaw_rad, &S::yaw_rate_rad_s}) {
    for (const float bad : {float(kNan), float(kInfinity), -float(kInfinity)}) {
      S setpoint = velocity_setpoint({1, 0, 0, 0}, 0, {});
      setpoint.*member = bad;
      EXPECT_FALSE(is_finite(setpoint));
      EXPECT_FALSE(velocity_of(setpoint));
    }
  }
}

TEST(Setpoint, OfAnotherFrameOrMaskIsNoVelocity) {
  for (int frame = 0; frame < 256; ++frame) {
    auto setpoint = velocity_setpoint({1, 0, 0, 0}, 0, {});
    setpoint.coordinate_frame = std::uint8_t(frame);
    EXPECT_EQ(velocity_of(setpoint).has_value(), frame == 8);
  }
  for (int bit = 0; bit < 16; ++bit) {
    auto setpoint = velocity_setpoint({1, 0, 0, 0}, 0, {});
    setpoint.type_mask = std::uint16_t(setpoint.type_mask ^ 1 << bit);
    EXPECT_FALSE(velocity_of(setpoint)) << bit;
  }
}

TEST(TimeBootMs, RoundsToMilliseconds) {
  EXPECT_EQ(time_boot_ms(0), 0u);
  EXPECT_EQ(time_boot_ms(1.001), 1001u);  // 1.001 * 1000 is less than 1001
  EXPECT_EQ(time_boot_ms(1.0 / 30), 33u);
  EXPECT_EQ(time_boot_ms(4294967.295), 4294967295u);
}

TEST(TimeBootMs, KeepsDifferencesWhateverTheOrigin) {
  for (const double origin_s : {-5.0, -0.001, 4294967.29, 1.7e9, 1e11}) {
    for (int ms = 0; ms < 50; ++ms) {
      // A double of 1e11 s still resolves 15 microseconds.
      EXPECT_EQ(time_boot_ms(origin_s + ms / 1000.0) - time_boot_ms(origin_s), std::uint32_t(ms));
    }
  }
}

TEST(TimeBootMs, OfNoTimeIsZero) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e308, -1e308}) {
    EXPECT_EQ(time_boot_ms(bad), 0u);
  }
}

}  // namespace
}  // namespace kestrel
