#include "kestrel/servo/servo.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "servo/oracle.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr Law kLaws[] = {Law::Cur, Law::Des, Law::Mean};
constexpr Freedom kFreedoms[] = {Freedom::Six, Freedom::Four, Freedom::Three};
const Mount kAtBody;  // camera and body are one: what ViSP calls EYEINHAND_CAMERA

Mount random_mount(test::Random& random) {
  return {rotation_from_vector(random.rotation_vector(M_PI)), random.vector3(0.5)};
}

TargetPose random_view(test::Random& random) {
  return {rotation_from_vector(random.rotation_vector(0.5)),
          random.vector3(0.3) + Eigen::Vector3d(0, 0, 1.5)};
}

TEST(Servo, IsTheLawOfThePapers) {
  test::Random random("servo oracle");
  const auto corners = test::square(0.4);
  for (const Law law : kLaws) {
    for (const Freedom freedom : kFreedoms) {
      for (int i = 0; i < 60; ++i) {
        const ServoOptions options{law, freedom, random.uniform(0.1, 2)};
        const Mount mount = random_mount(random);
        const auto measured = features(random_view(random), corners);
        const auto desired = features(random_view(random), corners);
        const auto expected = test::oracle_servo(measured, desired, mount, options);
        const auto answer = servo(measured, desired, mount, options);
        ASSERT_TRUE(answer);
        // Rounding times the square of the condition at worst (an error that no twist explains):
        // 7e-15 was seen.
        const double deviation =
            (answer->twist.vector() - expected.twist).norm() / expected.twist.norm();
        EXPECT_LT(deviation, 1e-13) << name(law) << ' ' << name(freedom);
        EXPECT_NEAR(answer->condition, expected.condition, 1e-9 * expected.condition);
        EXPECT_LT((answer->error - (test::stacked(measured) - test::stacked(desired))).norm(),
                  1e-15);
      }
    }
  }
}

// More than four points, and three: any number is least squares.
TEST(Servo, TakesThreePointsOrMore) {
  test::Random random("servo points");
  for (const std::size_t count : {3u, 5u, 12u}) {
    std::vector<Feature> measured;
    std::vector<Feature> desired;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = std::cos(2.4 * double(i)) * 0.3;  // spread over a circle
      const double y = std::sin(2.4 * double(i)) * 0.3;
      desired.push_back({{x, y}, random.uniform(1, 2)});
      measured.push_back({{x + random.uniform(-0.1, 0.1), y + random.uniform(-0.1, 0.1)}, 1.5});
    }
    const ServoOptions options;
    const Mount mount = random_mount(random);
    const auto answer = servo(measured, desired, mount, options);
    ASSERT_TRUE(answer);
    const auto expected = test::oracle_servo(measured, desired, mount, options);
    EXPECT_LT((answer->twist.vector() - expected.twist).norm(), 1e-11 * expected.twist.norm());
    EXPECT_EQ(answer->error.size(), Eigen::Index(2 * count));
  }
}

// The error the law sees moves at L v_c when the helicopter flies the answer: measured on a body
// that is moved by poses only, with the camera bolted to it.
TEST(Servo, MovesTheErrorAtTheRateOfTheTrueMatrix) {
  test::Random random("servo rate");
  const auto corners = test::square(0.4);
  const double h = 1e-5;
  for (const Freedom freedom : kFreedoms) {
    for (int i = 0; i < 40; ++i) {
      const Mount mount = random_mount(random);
      const auto body_from_target = mount * random_view(random);
      const auto desired = features(random_view(random), corners);
      const auto seen = [&](const BodyTwist& twist, double t) {
        const auto target_from_body = test::nudged(body_from_target.inverse(), twist, t);
        return features((target_from_body * mount).inverse(), corners);
      };
      const auto measured = seen({}, 0);
      const auto answer = servo(measured, desired, mount, {Law::Cur, freedom, 0.8});
      ASSERT_TRUE(answer);
      const BodyTwist body_twist = mount * answer->twist;
      const Eigen::VectorXd rate =
          (test::stacked(seen(body_twist, h)) - test::stacked(seen(body_twist, -h))) / (2 * h);
      const Eigen::VectorXd expected =
          test::oracle_interaction(measured).cast<double>() * answer->twist.vector();
      EXPECT_LT((rate - expected).norm(), 1e-7 * (1 + body_twist.vector().squaredNorm()));
      // Of all rates the freedom allows it is the one nearest to -gain e: what is left of the
      // difference no permitted velocity could change.
      const Eigen::MatrixXd J =
          (test::oracle_interaction(measured) * test::oracle_basis(mount, freedom)).cast<double>();
      const Eigen::VectorXd left = rate + 0.8 * answer->error;
      EXPECT_LT((J.transpose() * left).norm(),
                1e-6 * J.norm() * (1 + body_twist.vector().squaredNorm()));
    }
  }
}

// With the true matrix and as many velocities as numbers in e (three points, six velocities) the
// error decays as exp(-gain t), along a straight line.
TEST(Servo, DecaysAsAnExponentialWithTheTrueMatrix) {
  const double gain_per_s = 0.9;
  const double dt = 1e-3;
  const auto corners = test::square(0.2);
  const auto three = [&](const TargetPose& pose) {
    auto seen = features(pose, corners);
    seen.pop_back();
    return seen;
  };
  const auto desired = three(test::pose_of({0, 0, 1}, {0, 0, 0}));
  TargetPose pose = test::pose_of({0.1, -0.08, 1.3}, {6, -8, 20});
  const Eigen::VectorXd e0 = test::stacked(three(pose)) - test::stacked(desired);
  const Mount mount = test::forward_mount({0.3, 0, 0.1});
  for (int k = 0; k < 2000; ++k) {
    const ServoOptions options{Law::Cur, Freedom::Six, gain_per_s};
    // Midpoint rule: second order in dt.
    const auto first = servo(three(pose), desired, mount, options);
    ASSERT_TRUE(first);
    const auto half = test::nudged(pose.inverse(), first->twist, dt / 2).inverse();
    const auto second = servo(three(half), desired, mount, options);
    ASSERT_TRUE(second);
    pose = moved(pose.inverse(), second->twist, dt).inverse();
  }
  const Eigen::VectorXd e = test::stacked(three(pose)) - test::stacked(desired);
  EXPECT_LT((e - std::exp(-gain_per_s * 2) * e0).norm(), 1e-6 * e0.norm());
}

// The target and pose of ViSP's tutorial on image-based visual servoing from four points.
const auto kTutorialTarget = test::square(0.1);
const TargetPose kTutorialGoal = test::pose_of({0, 0, 0.75}, {0, 0, 0});
const TargetPose kTutorialStart = test::pose_of({0.15, -0.1, 1.0}, {10, -10, 50});

Servo tutorial_answer(const TargetPose& pose, Law law, double gain_per_s) {
  const auto answer =
      servo(features(pose, kTutorialTarget), features(kTutorialGoal, kTutorialTarget), kAtBody,
            {law, Freedom::Six, gain_per_s});
  EXPECT_TRUE(answer);
  return answer.value_or(Servo{});
}

TEST(Servo, AnswersTheFirstTwistsOfTheTutorial) {
  const auto expect_twist = [](Law law, std::array<double, 6> expected) {
    const Vector6d v = tutorial_answer(kTutorialStart, law, 1).twist.vector();
    // Six decimals are given.
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(v[i], expected[std::size_t(i)], 6e-7) << i;
  };
  expect_twist(Law::Cur, {.020066, -.089513, -.127833, .150247, .002328, 1.031707});
  expect_twist(Law::Des, {.199569, -.131016, .402333, -.071201, -.114750, .581608});
  expect_twist(Law::Mean, {.378162, .004703, .268493, .188034, -.311916, .903438});
}

TEST(Servo, EndsWhereTheTutorialEnds) {
  const auto expect_error = [](Law law, double expected) {
    TargetPose pose = kTutorialStart;
    EXPECT_NEAR(tutorial_answer(pose, law, 0.5).error.norm(), .469108342, 6e-10);
    for (int k = 0; k < 150; ++k) {
      const Servo answer = tutorial_answer(pose, law, 0.5);
      pose = moved(pose.inverse(), answer.twist, 0.04).inverse();
    }
    // Nine decimals after the leading zeros are given.
    EXPECT_NEAR(tutorial_answer(pose, law, 0.5).error.norm(), expected, 1e-11);
  };
  expect_error(Law::Cur, 2.253876834e-02);
  expect_error(Law::Des, 3.406660226e-02);
  expect_error(Law::Mean, 2.868349185e-02);
}

// Malis 2004: the mean matrix is right to second order, the other two to first.
TEST(Servo, HasTheOrderOfItsMatrix) {
  const Vector6d direction = (Vector6d() << .20, -.15, .25, .35, -.25, .60).finished();
  const auto miss = [&](Law law, double size) {
    const CameraTwist away = CameraTwist::from_vector(direction * size);
    const TargetPose pose = moved(kTutorialGoal.inverse(), away, 1).inverse();
    return (tutorial_answer(pose, law, 1).twist.vector() + away.vector()).norm();
  };
  const auto slope = [&](Law law) { return std::log2(miss(law, 0.0125) / miss(law, 0.00625)); };
  EXPECT_NEAR(slope(Law::Cur), 1.995, 6e-4);
  EXPECT_NEAR(slope(Law::Des), 2.004, 6e-4);
  EXPECT_NEAR(slope(Law::Mean), 2.994, 6e-4);
}

double condition_at(const TargetPose& pose, const std::array<Eigen::Vector3d, 4>& points,
                    const Mount& mount, Freedom freedom) {
  const auto seen = features(pose, points);
  const auto answer = servo(seen, seen, mount, {Law::Cur, freedom, 1});
  return answer ? answer->condition : kInf;
}

TEST(Servo, KnowsItsCondition) {
  const auto condition = [](const Mount& mount, Freedom freedom) {
    return condition_at(kTutorialGoal, kTutorialTarget, mount, freedom);
  };
  EXPECT_NEAR(condition(kAtBody, Freedom::Six), 118.7057, 5e-5);
  // Forward and yaw about the camera's y axis: sideways and yaw look alike.
  EXPECT_NEAR(condition(test::forward_mount({0, 0, 0}), Freedom::Four), 118.7, 0.05);
  EXPECT_NEAR(condition(test::down_mount({0, 0, 0}), Freedom::Four), 7.07, 0.005);
  EXPECT_NEAR(condition(test::forward_mount({0, 0, 0}), Freedom::Three), 5.30, 0.005);
  EXPECT_NEAR(condition(test::down_mount({0.3, 0, 0.1}), Freedom::Three), 5.30, 0.005);
  // 5 m before a target of 1 m, the camera ahead of the body's origin.
  const auto far_away = [](Freedom freedom, const Eigen::Vector3d& lever_arm) {
    return condition_at(test::pose_of({0, 0, 5}, {0, 0, 0}), test::square(0.5),
                        test::forward_mount(lever_arm), freedom);
  };
  EXPECT_NEAR(far_away(Freedom::Four, {0.3, 0, 0.1}), 592, 0.5);
  EXPECT_NEAR(far_away(Freedom::Six, {0, 0, 0}), 530, 0.5);
}

// The mount of a forward camera 0.3 m ahead and 0.1 m below: yaw moves it to the right.
TEST(Servo, CarriesTheLeverArm) {
  const Mount mount = test::forward_mount({0.3, 0, 0.1});
  const Eigen::MatrixXd V = test::oracle_twist_matrix(mount).cast<double>();
  const Vector6d first_row = (Vector6d() << 0, 1, 0, -.1, 0, .3).finished();
  EXPECT_LT((V.row(0).transpose() - first_row).norm(), 1e-15);
  const auto measured = features(test::pose_of({0.2, 0.1, 2}, {0, 0, 0}), test::square(0.3));
  const auto desired = features(test::pose_of({0, 0, 1.5}, {0, 5, 0}), test::square(0.3));
  const auto answer = servo(measured, desired, mount, {});
  ASSERT_TRUE(answer);
  const Vector6d v = answer->twist.vector();
  // Sideways for the camera (x) is sideways for the body plus 0.3 m of the yaw rate.
  const BodyTwist body_twist = mount * answer->twist;
  EXPECT_NEAR(v[0], body_twist.linear.y() + 0.3 * body_twist.angular.z(), 1e-12);
  EXPECT_GT(std::abs(body_twist.angular.z()), 1e-3);
}

TEST(Servo, UsesOnlyThePermittedVelocities) {
  test::Random random("servo permitted");
  for (const Law law : kLaws) {
    for (int i = 0; i < 50; ++i) {
      const Mount mount = random_mount(random);
      const auto measured = features(random_view(random), test::square(0.4));
      const auto desired = features(random_view(random), test::square(0.4));
      const auto four = servo(measured, desired, mount, {law, Freedom::Four, 1});
      const auto three = servo(measured, desired, mount, {law, Freedom::Three, 1});
      ASSERT_TRUE(four && three);
      // Rounding of the way to the camera and back, at speeds of some m/s.
      EXPECT_LT((mount * four->twist).angular.head<2>().norm(), 1e-13);
      EXPECT_LT((mount * three->twist).angular.norm(), 1e-13);
    }
  }
}

// vpServo computes the desired matrix once and keeps it: a goal that moves must move the answer.
TEST(Servo, ForgetsTheDesiredMatrixOfTheLastCall) {
  const auto measured = features(kTutorialStart, kTutorialTarget);
  const ServoOptions options{Law::Des, Freedom::Six, 1};
  for (const double depth : {0.75, 1.5, 0.75, 3.0}) {
    auto desired = features(kTutorialGoal, kTutorialTarget);
    for (Feature& f : desired) f.depth_m = depth;
    const auto answer = servo(measured, desired, kAtBody, options);
    ASSERT_TRUE(answer);
    const auto expected = test::oracle_servo(measured, desired, kAtBody, options);
    EXPECT_LT((answer->twist.vector() - expected.twist).norm(), 1e-12 * expected.twist.norm());
  }
}

TEST(Servo, IsProportionalToTheGain) {
  const Vector6d one = tutorial_answer(kTutorialStart, Law::Mean, 1).twist.vector();
  const Vector6d three = tutorial_answer(kTutorialStart, Law::Mean, 3).twist.vector();
  EXPECT_LT((three - 3 * one).norm(), 1e-14);
}

TEST(Servo, StandsStillAtTheGoal) {
  for (const Law law : kLaws) {
    EXPECT_EQ(tutorial_answer(kTutorialGoal, law, 1).twist.vector(), Vector6d::Zero());
  }
}

class ServoOfNonsense : public testing::Test {
 protected:
  static std::optional<Servo> ask(const std::vector<Feature>& measured,
                                  const std::vector<Feature>& desired) {
    return servo(measured, desired, kAtBody, {Law::Mean, Freedom::Six, 1});
  }
  const std::vector<Feature> good_ = features(kTutorialGoal, kTutorialTarget);
};

TEST_F(ServoOfNonsense, IsEmptyForNumbersNoCameraGives) {
  ASSERT_TRUE(ask(good_, good_));
  for (const double bad : {kNan, kInf, -kInf, 1e300, -1e300}) {
    for (const int field : {0, 1, 2}) {
      auto broken = good_;
      (field == 0 ? broken[2].at.x : field == 1 ? broken[2].at.y : broken[2].depth_m) = bad;
      EXPECT_FALSE(ask(broken, good_)) << bad << ' ' << field;
      EXPECT_FALSE(ask(good_, broken)) << bad << ' ' << field;
    }
  }
  for (const double depth : {0.0, -0.0, 1e-7, -0.75}) {
    auto broken = good_;
    broken[3].depth_m = depth;
    EXPECT_FALSE(ask(broken, good_)) << depth;
    EXPECT_FALSE(ask(good_, broken)) << depth;
  }
}

TEST_F(ServoOfNonsense, IsEmptyForTooFewPointsOrUnequalNumbers) {
  auto fewer = good_;
  fewer.pop_back();
  EXPECT_FALSE(ask(fewer, good_));
  EXPECT_FALSE(ask(good_, fewer));
  EXPECT_TRUE(ask(fewer, fewer));
  fewer.pop_back();
  EXPECT_FALSE(ask(fewer, fewer));
  EXPECT_FALSE(ask({}, {}));
}

// On a line, and nearly on one: the twist about the line is not seen, and must not be guessed.
TEST_F(ServoOfNonsense, IsEmptyForPointsOnALine) {
  for (const double off : {0.0, 1e-9, 1e-6}) {
    std::vector<Feature> line;
    for (int i = 0; i < 4; ++i) line.push_back({{0.1 * i - 0.15, 0.05 * i + off * i * i}, 1});
    auto there = line;
    for (Feature& f : there) f.at.x += 0.01;
    for (const Law law : kLaws) {
      const ServoOptions options{law, Freedom::Six, 1};
      EXPECT_FALSE(servo(line, there, kAtBody, options)) << off;
    }
  }
}

TEST_F(ServoOfNonsense, IsEmptyForPointsAtOnePlace) {
  const std::vector<Feature> place(4, Feature{{0.1, 0.1}, 1});
  for (const Freedom freedom : kFreedoms) {
    EXPECT_FALSE(servo(place, place, kAtBody, {Law::Cur, freedom, 1}));
  }
}

// A target so far away that sideways and yaw are one: no answer, in place of a wild one.
TEST_F(ServoOfNonsense, IsEmptyBeyondTheLargestCondition) {
  const Mount mount = test::forward_mount({0, 0, 0});
  int answers = 0;
  for (double far_m = 1; far_m < 200; far_m *= 1.1) {
    const auto measured = features(test::pose_of({0.1, 0, far_m}, {0, 0, 0}), test::square(0.5));
    const auto desired = features(test::pose_of({0, 0, far_m}, {0, 0, 0}), test::square(0.5));
    const auto answer = servo(measured, desired, mount, {});
    const double condition = test::oracle_servo(measured, desired, mount, {}).condition;
    EXPECT_EQ(answer.has_value(), condition <= kLargestCondition) << far_m;
    answers += answer.has_value();
  }
  EXPECT_GT(answers, 10);
  EXPECT_LT(answers, 50);
}

TEST_F(ServoOfNonsense, IsEmptyForAMountThatIsNoRotation) {
  const auto ask_mounted = [&](const Mount& mount) { return servo(good_, good_, mount, {}); };
  ASSERT_TRUE(ask_mounted(kAtBody));
  Mount mirrored;
  mirrored.rotation(0, 0) = -1;
  EXPECT_FALSE(ask_mounted(mirrored));
  Mount scaled;
  scaled.rotation *= 1.01;
  EXPECT_FALSE(ask_mounted(scaled));
  for (const double bad : {kNan, kInf, 1e300}) {
    Mount broken;
    broken.translation.y() = bad;
    EXPECT_FALSE(ask_mounted(broken));
    broken = {};
    broken.rotation(1, 2) = bad;
    EXPECT_FALSE(ask_mounted(broken));
  }
}

TEST_F(ServoOfNonsense, IsEmptyForAGainThatIsNotFinite) {
  for (const double bad : {kNan, kInf, -kInf}) {
    EXPECT_FALSE(servo(good_, good_, kAtBody, {Law::Mean, Freedom::Six, bad}));
  }
}

// Sense or nonsense, nothing is printed and nothing thrown.
TEST_F(ServoOfNonsense, IsSilent) {
  test::Random random("servo silent");
  const double numbers[] = {0, -1, 1e-7, 1e-6, 1, 1e6, 1e300, kNan, kInf, 0.3, -0.2};
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  int answers = 0;
  for (int i = 0; i < 3000; ++i) {
    auto measured = good_;
    auto desired = good_;
    for (int k = 0; k < random.integer(0, 3); ++k) {
      Feature& f = (random.integer(0, 1) ? measured : desired)[std::size_t(random.integer(0, 3))];
      const double number = numbers[random.integer(0, 10)];
      const int field = random.integer(0, 2);
      (field == 0 ? f.at.x : field == 1 ? f.at.y : f.depth_m) = number;
    }
    const ServoOptions options{kLaws[random.integer(0, 2)], kFreedoms[random.integer(0, 2)], 1};
    std::optional<Servo> answer;
    EXPECT_NO_THROW(answer = servo(measured, desired, random_mount(random), options));
    if (!answer) continue;
    ++answers;
    EXPECT_TRUE(answer->twist.vector().allFinite());
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(answers, 500);
}

TEST(Servo, GivesTheSameBitsInAnyThread) {
  const Vector6d here = tutorial_answer(kTutorialStart, Law::Mean, 1).twist.vector();
  Vector6d there = Vector6d::Zero();
  std::thread([&] { there = tutorial_answer(kTutorialStart, Law::Mean, 1).twist.vector(); }).join();
  EXPECT_EQ(here, there);
}

TEST(ServoOptions, CheckNamesTheGainAndItsUnit) {
  EXPECT_NO_THROW(ServoOptions{}.check());
  for (const double bad : {0.0, -0.5, kNan, kInf}) {
    try {
      ServoOptions{Law::Mean, Freedom::Four, bad}.check();
      ADD_FAILURE() << bad;
    } catch (const std::invalid_argument& e) {
      EXPECT_THAT(e.what(), testing::StartsWith("gain_per_s: must be positive and finite (1/s)"));
    }
  }
}

TEST(ServoOptions, CheckNamesWhatBelongsToTheLaw) {
  const auto complaint = [](auto change) -> std::string {
    ServoOptions options;
    change(options);
    try {
      options.check();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  using testing::StartsWith;
  EXPECT_THAT(complaint([](ServoOptions& o) { o.far_gain_per_s = 0.6; }),
              StartsWith("far_gain_per_s: must be"));
  EXPECT_THAT(complaint([](ServoOptions& o) { o.gain_slope_per_s = -1; }),
              StartsWith("gain_slope_per_s: must be"));
  EXPECT_THAT(complaint([](ServoOptions& o) { o.forgetting = 0; }),
              StartsWith("forgetting: must be"));
  EXPECT_EQ(complaint([](ServoOptions& o) { o.far_gain_per_s = 0.5; }), "");
}

TEST(ServoOptions, BecomeThoseOfTheLaw) {
  ServoOptions options;
  options.law = Law::Rls;
  options.gain_per_s = 4;
  EXPECT_EQ(law_options(options).gain.at(10), 4);
  options.far_gain_per_s = 0.4;
  options.gain_slope_per_s = 30;
  options.smooth_start_per_s = 1;
  options.damping = 2;
  options.learning_gate = 3;
  options.forgetting = 0.4;
  options.initial_covariance = 5;
  const LawOptions law = law_options(options);
  EXPECT_EQ(law.law, Law::Rls);
  EXPECT_EQ(law.solver, LawSolver::Visp);
  EXPECT_EQ(law.gain.at(0), 4);
  EXPECT_NEAR(law.gain.at(1e9), 0.4, 1e-15);
  EXPECT_EQ(law.gain.slope_at_zero_per_s, 30);
  EXPECT_EQ(law.max_condition, kLargestCondition);
  EXPECT_EQ(law.smooth_start_per_s, 1);
  EXPECT_EQ(law.damping, 2);
  EXPECT_EQ(law.learning_gate, 3);
  EXPECT_EQ(law.forgetting, 0.4);
  EXPECT_EQ(law.initial_covariance, 5);
}

TEST(LawOnBody, SaysWhyThereIsNoAnswer) {
  LawInput input;
  input.measured = input.desired = features(kTutorialGoal, kTutorialTarget);
  Mount mirrored;
  mirrored.rotation(0, 0) = -1;
  LawState state;
  state.features = Eigen::VectorXd::Ones(3);
  const LawAnswer unreachable = law_on_body(input, mirrored, {}, state);
  EXPECT_EQ(unreachable.refusal, LawRefusal::Unreachable);
  EXPECT_FALSE(unreachable.twist);
  EXPECT_EQ(unreachable.next.features, state.features);
  ServoOptions endless;
  endless.gain_per_s = kInf;
  EXPECT_EQ(law_on_body(input, kAtBody, endless).refusal, LawRefusal::NotFinite);
  input.measured.pop_back();
  EXPECT_EQ(law_on_body(input, kAtBody, {}).refusal, LawRefusal::Unequal);
}

TEST(Freedom, HasAName) {
  EXPECT_STREQ(name(Freedom::Six), "six");
  EXPECT_STREQ(name(Freedom::Four), "four");
  EXPECT_STREQ(name(Freedom::Three), "three");
}

}  // namespace
}  // namespace kestrel
