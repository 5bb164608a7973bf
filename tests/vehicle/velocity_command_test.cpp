#include "kestrel/vehicle/velocity_command.hpp"

#include <limits>
#include <type_traits>

#include <gtest/gtest.h>

#include "kestrel/geometry/transform.hpp"

namespace kestrel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// A camera twist is no body twist: only a mount turns one into the other.
static_assert(!std::is_invocable_v<decltype(to_command), CameraTwist>);
static_assert(std::is_invocable_v<decltype(to_command), BodyTwist>);

TEST(VelocityCommand, TakesTheFourVelocitiesOfTheBody) {
  const BodyTwist twist = BodyTwist::from_vector((Vector6d() << 1, 2, 3, 4, 5, 6).finished());
  const VelocityCommand command = to_command(twist);
  EXPECT_EQ(command.forward_m_s, 1);
  EXPECT_EQ(command.right_m_s, 2);
  EXPECT_EQ(command.down_m_s, 3);
  EXPECT_EQ(command.yaw_rate_rad_s, 6);
}

TEST(VelocityCommand, VectorAndCommandAreInverse) {
  const VelocityCommand command{1, 2, 3, 4};
  EXPECT_EQ(command.vector(), Eigen::Vector4d(1, 2, 3, 4));
  EXPECT_EQ(VelocityCommand::from_vector(command.vector()).vector(), command.vector());
}

// Also where the number that is not finite is one that the command would not carry: a law that
// answers NaN for a roll rate is not to be believed in the rest.
TEST(VelocityCommand, IsHoverForATwistThatIsNotFinite) {
  for (int i = 0; i < 6; ++i) {
    for (const double bad : {kNan, kInf, -kInf}) {
      Vector6d v = Vector6d::Ones();
      v[i] = bad;
      EXPECT_EQ(to_command(BodyTwist::from_vector(v)).vector(), Eigen::Vector4d::Zero());
    }
  }
}

TEST(VelocityCommand, IsFiniteWhenEveryComponentIs) {
  EXPECT_TRUE(is_finite(VelocityCommand::hover()));
  for (int i = 0; i < 4; ++i) {
    for (const double bad : {kNan, kInf, -kInf}) {
      Eigen::Vector4d v = Eigen::Vector4d::Ones();
      EXPECT_TRUE(is_finite(VelocityCommand::from_vector(v)));
      v[i] = bad;
      EXPECT_FALSE(is_finite(VelocityCommand::from_vector(v)));
    }
  }
}

}  // namespace
}  // namespace kestrel
