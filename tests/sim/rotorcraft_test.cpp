#include "kestrel/sim/rotorcraft.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kStep_s = 0.005;
const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

RotorcraftState flown(RotorcraftState s, const RotorcraftControls& controls, double duration_s,
                      const RotorcraftOptions& o, const Eigen::Vector3d& wind = kStill,
                      double step_s = kStep_s) {
  for (int i = 0, n = int(std::lround(duration_s / step_s)); i < n; ++i) {
    s = advanced(s, controls, wind, step_s, o);
  }
  return s;
}

RotorcraftOptions without_air() {
  RotorcraftOptions o;
  o.damping_per_s.setZero();
  o.drag_area_m2.setZero();
  o.yaw_damping_per_s = 0;
  return o;
}

RotorcraftState tumbling(test::Random& random) {
  RotorcraftState s;
  s.position_m = random.vector3(10);
  s.velocity_m_s = random.vector3(5);
  const Eigen::Vector3d turn = random.rotation_vector(2);
  s.world_from_body = Eigen::AngleAxisd(turn.norm(), turn.normalized());
  s.rate_rad_s = random.vector3(2);
  return s;
}

double energy(const RotorcraftState& s, const RotorcraftOptions& o) {
  return 0.5 * o.mass_kg * s.velocity_m_s.squaredNorm() -
         o.mass_kg * o.gravity_m_s2 * s.position_m.z() +
         0.5 * s.rate_rad_s.dot(o.inertia_kg_m2.cwiseProduct(s.rate_rad_s));
}

Eigen::Vector3d spin(const RotorcraftState& s, const RotorcraftOptions& o) {
  return s.world_from_body * o.inertia_kg_m2.cwiseProduct(s.rate_rad_s);
}

TEST(Rotorcraft, HoversWhereItsForcesBalance) {
  const RotorcraftOptions o;
  test::Random random("rotorcraft hover");
  for (int i = 0; i < 10; ++i) {
    const RotorcraftState start = hovering(random.vector3(5), random.uniform(-3, 3), o);
    const RotorcraftState end = flown(start, trim(start), 10, o);
    EXPECT_LT((end.position_m - start.position_m).norm(), 1e-9);  // rounding, grown for 10 s
    EXPECT_LT(end.velocity_m_s.norm(), 1e-9);
    EXPECT_LT(end.rate_rad_s.norm(), 1e-9);
  }
}

// By hand: T = 12 x 9.81 N, disc 2.545 m2: inflow 4.39 m/s, 517 W, 861 W at figure of merit 0.6.
TEST(Rotorcraft, TailHoldsTheTorqueAndRollHoldsTheTail) {
  const RotorcraftOptions o;
  EXPECT_NEAR(main_rotor_torque_n_m(117.72, o), 861.3 / 150, 0.01);
  EXPECT_EQ(main_rotor_torque_n_m(0, o), 0);
  EXPECT_EQ(main_rotor_torque_n_m(-1, o), 0);
  const RotorcraftState s = hovering({0, 0, 0}, 0, o);
  EXPECT_NEAR(s.tail_n * o.tail_arm_m, main_rotor_torque_n_m(s.thrust_n, o), 1e-12);
  const Eigen::Vector3d down = s.world_from_body.inverse() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::atan2(down.y(), down.z()), std::asin(s.tail_n / 117.72), 1e-12);
  EXPECT_GT(down.y(), 0.03);  // right side down
}

TEST(Rotorcraft, FallsFreely) {
  RotorcraftOptions o = without_air();
  const RotorcraftState end = flown({}, {}, 3, o);
  EXPECT_NEAR(end.velocity_m_s.z(), 9.81 * 3, 1e-10);
  EXPECT_NEAR(end.position_m.z(), 9.81 * 9 / 2, 1e-9);
}

// Gravity alone and no moment: energy and angular momentum stay. Tolerance: the truncation error of
// RK4 at 2 rad/s and 5 ms, (rate h)^5 per step, over 2000 steps.
TEST(Rotorcraft, KeepsEnergyAndSpinWhereNothingActs) {
  RotorcraftOptions o = without_air();
  o.hub_stiffness_n_m = 0;
  test::Random random("conservation");
  for (int i = 0; i < 10; ++i) {
    const RotorcraftState start = tumbling(random);
    const RotorcraftState end = flown(start, {}, 10, o);
    EXPECT_NEAR(energy(end, o), energy(start, o), 1e-6 * std::abs(energy(start, o)) + 1e-6);
    EXPECT_LT((spin(end, o) - spin(start, o)).norm(), 1e-6);
  }
}

TEST(Rotorcraft, AirOnlyTakesEnergy) {
  const RotorcraftOptions o;
  test::Random random("dissipation");
  for (int i = 0; i < 10; ++i) {
    RotorcraftOptions loose = o;
    loose.hub_stiffness_n_m = 0;
    RotorcraftState s = tumbling(random);
    for (int k = 0; k < 400; ++k) {
      const RotorcraftState next = advanced(s, {}, kStill, kStep_s, loose);
      EXPECT_LE(energy(next, loose), energy(s, loose) + 1e-9);
      s = next;
    }
  }
}

TEST(Rotorcraft, KnowsNoHeading) {
  const RotorcraftOptions o;
  test::Random random("heading symmetry");
  for (int i = 0; i < 5; ++i) {
    RotorcraftState s = tumbling(random);
    s.thrust_n = 100;
    const RotorcraftControls controls{110, 0.02, -0.01, 4};
    const Eigen::Vector3d wind = random.vector3(4);
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(random.uniform(-3, 3), Eigen::Vector3d::UnitZ()));
    RotorcraftState turned = s;
    turned.position_m = turn * s.position_m;
    turned.velocity_m_s = turn * s.velocity_m_s;
    turned.world_from_body = turn * s.world_from_body;
    const RotorcraftState a = flown(s, controls, 1, o, wind);
    const RotorcraftState b = flown(turned, controls, 1, o, turn * wind);
    EXPECT_LT((turn * a.position_m - b.position_m).norm(), 1e-9);
    EXPECT_LT((turn * a.world_from_body).angularDistance(b.world_from_body), 1e-7);
  }
}

// Without torque and tail, left and right are the same.
TEST(Rotorcraft, IsItsOwnMirrorImageWithoutTorque) {
  RotorcraftOptions o;
  o.figure_of_merit = 1e12;
  RotorcraftState s;
  s.thrust_n = 117.72;
  const RotorcraftState a = flown(s, {120, 0.01, 0.02, 0}, 1, o);
  const RotorcraftState b = flown(s, {120, 0.01, -0.02, 0}, 1, o);
  EXPECT_NEAR(a.position_m.x(), b.position_m.x(), 1e-9);
  EXPECT_NEAR(a.position_m.y(), -b.position_m.y(), 1e-9);
  EXPECT_NEAR(a.position_m.z(), b.position_m.z(), 1e-9);
  EXPECT_GT(a.position_m.y(), 0.05);  // disc to the right: it goes right
}

TEST(Rotorcraft, ForcesGoWhereTheDiscLeans) {
  const RotorcraftOptions o;
  const RotorcraftState start = hovering({0, 0, 0}, 0, o);
  RotorcraftControls controls = trim(start);
  controls.back_rad = -0.01;
  const RotorcraftState nose_down = flown(start, controls, 0.5, o);
  EXPECT_GT(nose_down.velocity_m_s.x(), 0.01);
  EXPECT_LT(nose_down.rate_rad_s.y(), 0);
  controls = trim(start);
  controls.tail_n += 1;
  EXPECT_GT(flown(start, controls, 0.2, o).rate_rad_s.z(), 0);  // clockwise from above
}

// With the roll rate steady the disc lies square to the shaft: rate = cyclic / time constant.
TEST(Rotorcraft, RollRateSettlesAtCyclicOverTimeConstant) {
  RotorcraftOptions o = without_air();
  o.gravity_m_s2 = 1e-9;
  o.figure_of_merit = 1e12;
  const RotorcraftState s = flown({}, {0, 0, 0.02, 0}, 2, o);
  EXPECT_NEAR(s.rate_rad_s.x(), 0.02 / 0.05, 1e-6);
  EXPECT_NEAR(s.flap_right_rad, 0, 1e-6);
}

TEST(Rotorcraft, ThrustAndTailFollowWithTheirTimeConstants) {
  RotorcraftOptions o;
  const RotorcraftState a = flown({}, {100, 0, 0, 10}, 0.10, o, kStill, 0.001);
  EXPECT_NEAR(a.thrust_n, 100 * (1 - std::exp(-1)), 1e-6);
  EXPECT_NEAR(a.tail_n, 10 * (1 - std::exp(-0.10 / 0.06)), 1e-6);
}

TEST(Rotorcraft, ClimbsUntilHeaveDampingEatsTheExcess) {
  RotorcraftOptions o;
  o.drag_area_m2.setZero();
  o.figure_of_merit = 1e12;
  RotorcraftState s;
  s.thrust_n = o.mass_kg * o.gravity_m_s2 + 6;
  const RotorcraftState end = flown(s, {s.thrust_n, 0, 0, 0}, 30, o);
  EXPECT_NEAR(end.velocity_m_s.z(), -6 / (o.mass_kg * 0.61), 1e-6);
}

TEST(Rotorcraft, IsCarriedByTheWind) {
  RotorcraftOptions o;
  const RotorcraftState start = hovering({0, 0, 0}, 0, o);
  const RotorcraftState end = flown(start, trim(start), 0.5, o, {0, 5, 0});
  // F = m 0.15/s 5 m/s + 0.5 1.2 0.35 25 N, half a second.
  EXPECT_NEAR(end.velocity_m_s.y(), (0.75 + 5.25 / 12) * 0.5, 0.06);  // it slows as it goes along
}

TEST(Rotorcraft, IntegratesToFourthOrder) {
  const RotorcraftOptions o;
  RotorcraftState start = hovering({0, 0, 0}, 0, o);
  const RotorcraftControls controls{125, 0.02, -0.03, 7};
  const auto end = [&](double h) {
    return flown(start, controls, 0.64, o, {2, 1, 0}, h).position_m;
  };
  const Eigen::Vector3d exact = end(0.0005);
  const double ratio = (end(0.016) - exact).norm() / (end(0.008) - exact).norm();
  EXPECT_GT(ratio, 12);
  EXPECT_LT(ratio, 24);
}

TEST(Rotorcraft, RefusesOptionsOutOfRange) {
  RotorcraftOptions o;
  EXPECT_NO_THROW(o.check());
  o.mass_kg = 0;
  EXPECT_THROW(o.check(), std::invalid_argument);
  o = {};
  o.inertia_kg_m2.y() = -1;
  EXPECT_THROW(o.check(), std::invalid_argument);
  o = {};
  o.damping_per_s.x() = std::nan("");
  EXPECT_THROW(o.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
