#include "kestrel/vehicle/dead_reckoning.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

const VelocityResponse kResponse;

DeadReckoning flying(const VelocityCommand& velocity, const VelocityCommand& command) {
  DeadReckoning motion;
  motion.velocity = velocity;
  return told(motion, {0, command});
}

// Each axis settles at its command; after one time constant a lag has 1 - 1/e of it.
TEST(DeadReckoning, FollowsItsCommandsAxisByAxis) {
  const VelocityCommand command{1, -0.5, 0.4, 0.3};
  const DeadReckoning start = flying({}, command);
  const Vector4d late = advanced(start, 10, kResponse).velocity.vector();
  EXPECT_LT((late - command.vector()).norm(), 1e-6);
  const double share = 1 - std::exp(-1);
  EXPECT_NEAR(advanced(start, kResponse.vertical_s, kResponse).velocity.down_m_s, 0.4 * share,
              1e-12);
  EXPECT_NEAR(advanced(start, kResponse.yaw_s, kResponse).velocity.yaw_rate_rad_s, 0.3 * share,
              1e-12);
}

// v'' velocity tilt + v' velocity + v = c has damping z and frequency w: its step response is known
// (v = 1 - e^(-z w t) (cos d t + z w / d sin d t), d = w sqrt(1 - z^2)).
TEST(DeadReckoning, TiltsAsASecondOrderLag) {
  const double w = 1 / std::sqrt(kResponse.velocity_s * kResponse.tilt_s);
  const double zw = 1 / (2 * kResponse.tilt_s);
  const double d = std::sqrt(w * w - zw * zw);
  for (const double t : {0.05, 0.2, 0.5, 1.0, 2.0}) {
    const DeadReckoning at = advanced(flying({}, {1, 1, 0, 0}), t, kResponse);
    const double exact = 1 - std::exp(-zw * t) * (std::cos(d * t) + zw / d * std::sin(d * t));
    EXPECT_NEAR(at.velocity.forward_m_s, exact, 5e-4) << t;  // of steps of 10 ms
    EXPECT_NEAR(at.velocity.right_m_s, exact, 5e-4) << t;
  }
}

TEST(DeadReckoning, ObeysEachCommandFromItsTimeOn) {
  DeadReckoning motion;
  motion = told(motion, {1, {1, 0, 0, 0}});
  motion = told(motion, {2, {0, 0, 0.5, 0}});
  EXPECT_EQ(advanced(motion, 1, kResponse).velocity.vector(), Vector4d::Zero());
  EXPECT_GT(advanced(motion, 1.5, kResponse).velocity.forward_m_s, 0.3);
  EXPECT_EQ(advanced(motion, 2, kResponse).velocity.down_m_s, 0);
  const Vector4d settled = advanced(motion, 12, kResponse).velocity.vector();
  EXPECT_LT((settled - Vector4d(0, 0, 0.5, 0)).norm(), 1e-6);
  // One told for an earlier time takes the place of those after it.
  const DeadReckoning replaced = told(motion, {0.5, {0, 0, 0, 0}});
  EXPECT_EQ(advanced(replaced, 12, kResponse).velocity.vector(), Vector4d::Zero());
}

TEST(DeadReckoning, ForgetsWhatIsOver) {
  DeadReckoning motion;
  for (int k = 0; k < 1000; ++k) {
    motion = told(advanced(motion, k / 30.0, kResponse), {k / 30.0 + 0.1, {1, 0, 0, 0}});
  }
  EXPECT_LE(motion.told.size(), 6u);
}

// In pieces or at once: the same, to what the steps' places leave.
TEST(DeadReckoning, ComposesOverTime) {
  DeadReckoning motion = flying({0.5, 0.2, 0, 0.1}, {1, -1, 0.3, 0.4});
  motion = told(motion, {0.77, {0, 0.5, 0, -0.2}});
  const DeadReckoning half = advanced(motion, 0.6, kResponse);
  const BodyMotion first = travelled(motion, 0.6, kResponse);
  const BodyMotion then = travelled(half, 0.9, kResponse);
  const BodyMotion both = travelled(motion, 1.5, kResponse);
  EXPECT_LT(((then * first).translation - both.translation).norm(), 1e-4);
  EXPECT_LT(((then * first).rotation - both.rotation).norm(), 1e-4);
}

// At a constant velocity with a constant turn the body flies a circle: r = v / w.
TEST(DeadReckoning, FliesACircle) {
  const double v = 1.2;
  const double w = 0.5;
  const DeadReckoning motion = flying({v, 0, 0.3, w}, {v, 0, 0.3, w});
  const BodyMotion now_from_then = travelled(motion, 2, kResponse);
  const double turned = 2 * w;
  const Vector3d place = now_from_then.inverse().translation;
  const Vector3d expected(v / w * std::sin(turned), v / w * (1 - std::cos(turned)), 0.6);
  EXPECT_LT((place - expected).norm(), 1e-4);
  EXPECT_NEAR(rotation_vector(now_from_then.rotation).z(), -turned, 1e-9);
}

TEST(DeadReckoning, StaysWhereNoTimePasses) {
  const DeadReckoning motion = flying({1, 1, 1, 1}, {});
  EXPECT_EQ(travelled(motion, 0, kResponse).translation, Vector3d::Zero());
  EXPECT_EQ(advanced(motion, -1, kResponse).velocity.vector(), motion.velocity.vector());
}

TEST(DeadReckoning, RefusesResponsesOutOfRange) {
  const auto named = [](auto change) -> std::string {
    VelocityResponse r;
    change(r);
    try {
      r.check();
    } catch (const std::invalid_argument& e) {
      return std::string(e.what()).substr(0, std::string(e.what()).find(':'));
    }
    return "";
  };
  EXPECT_EQ(named([](VelocityResponse& r) { r.velocity_s = 0; }), "velocity_s");
  EXPECT_EQ(named([](VelocityResponse& r) { r.tilt_s = -1; }), "tilt_s");
  EXPECT_EQ(named([](VelocityResponse& r) { r.vertical_s = NAN; }), "vertical_s");
  EXPECT_EQ(named([](VelocityResponse& r) { r.yaw_s = INFINITY; }), "yaw_s");
  EXPECT_EQ(named([](VelocityResponse&) {}), "");
}

}  // namespace
}  // namespace kestrel
