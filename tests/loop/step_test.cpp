#include "kestrel/loop/step.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "loop/camera_view.hpp"
#include "loop/flight.hpp"
#include "servo/oracle.hpp"

namespace kestrel {
namespace {

using Eigen::Vector4d;
using test::Flight;

constexpr double kFrame = 1.0 / 30;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A forward camera before the painted plane.
class StepOfTheLoop : public testing::Test {
 protected:
  Frame frame_from(const Flight& flight, std::int64_t index) const {
    Frame frame;
    frame.index = index;
    frame.stamp_s = double(index) * kFrame;
    frame.gray = test::view(task_.camera, pose_at(flight));
    frame.attitude = flight.attitude;
    return frame;
  }
  Frame black(std::int64_t index) const {
    Frame frame;
    frame.index = index;
    frame.stamp_s = double(index) * kFrame;
    frame.gray = cv::Mat(240, 320, CV_8UC1, cv::Scalar(0));
    return frame;
  }
  TargetPose pose_at(const Flight& flight) const {
    return flight.camera(task_.body_from_camera).inverse() * target_;
  }

  const Task task_ = test::example_task(test::forward_camera());
  const test::WorldFromTarget target_ = test::target_for(task_);
  const cv::Mat picture_ = test::target_picture(100, 80, 1, 0.8);
  Tracker tracker_{picture_, {0, 0, 100, 80}, task_.track};
  const Template& model_ = tracker_.model();
  // The template was learned elsewhere: where its picture lay tells nothing here, so look
  // everywhere.
  const LoopState everywhere_ = [this] {
    LoopState state = start(tracker_, black(0));
    state.track.window = {0, 0, 320, 240};
    return state;
  }();
};

TEST_F(StepOfTheLoop, StartsFromHoverAtTheTemplatesPlace) {
  const LoopState state = start(tracker_, black(0));
  const TrackState track = tracker_.start(320, 240);
  EXPECT_EQ(state.track.window.width, track.window.width);
  EXPECT_EQ(state.track.window.height, track.window.height);
  EXPECT_FALSE(state.pose);
  EXPECT_FALSE(state.decision.stamp_s);
  EXPECT_FALSE(state.decision.seen_stamp_s);
  EXPECT_EQ(state.decision.sent.vector(), Vector4d::Zero());
}

// Corners exact for an exact homography: the outer edges of the template's pixels are the edges of
// the target, whatever its size in pixels, and the depth is along the optical axis.
TEST_F(StepOfTheLoop, PutsTheFeaturesAtTheEdgesOfTheTarget) {
  const Flight flight{{-0.4, 0.2, 0.1}, {0.1, -0.1, 0.2}};
  const TargetPose pose = pose_at(flight);
  // Pixels of the template to metres of the plane, to the camera, to pixels of the image.
  Eigen::Matrix3d plane_from_template;
  plane_from_template << 0.01, 0, 0.5 * 0.01 - 0.5, 0, 0.01, 0.5 * 0.01 - 0.4, 0, 0, 1;
  Eigen::Matrix3d camera_from_plane;
  camera_from_plane << pose.rotation.col(0), pose.rotation.col(1), pose.translation;
  const Homography exact{task_.camera.K() * camera_from_plane * plane_from_template};
  const auto corners = corner_features(exact, model_, pose, task_);
  const auto expected = features(pose, target_corners(task_));
  ASSERT_EQ(corners.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(corners[i].at.x, expected[i].at.x, 1e-13);
    EXPECT_NEAR(corners[i].at.y, expected[i].at.y, 1e-13);
    EXPECT_NEAR(corners[i].depth_m, expected[i].depth_m, 1e-13);
  }
}

TEST_F(StepOfTheLoop, SeesTheTargetWhereItIs) {
  const Flight flight{{-0.4, 0.2, 0.1}, {0.1, -0.1, 0.2}};
  const Step s = step(tracker_, frame_from(flight, 1), everywhere_, task_);
  ASSERT_TRUE(s.track.found()) << name(s.track.miss);
  ASSERT_TRUE(s.pose);
  const auto expected = features(pose_at(flight), target_corners(task_));
  ASSERT_EQ(s.measured.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    // Half a pixel at the corner: 0.5 / 300. The depth follows the size, 100 px to half a pixel,
    // and the slant, some degrees of half a metre.
    EXPECT_NEAR(s.measured[i].at.x, expected[i].at.x, 0.5 / 300);
    EXPECT_NEAR(s.measured[i].at.y, expected[i].at.y, 0.5 / 300);
    EXPECT_NEAR(s.measured[i].depth_m, expected[i].depth_m, 0.05);
  }
}

// The chain is the chain: what is decided is decided from what was measured, and what comes out
// goes in at the next frame.
TEST_F(StepOfTheLoop, HandsOnWhatItFound) {
  const Flight flight{{-0.4, 0.2, 0.1}, {0.1, -0.1, 0.2}};
  const Step first = step(tracker_, frame_from(flight, 1), everywhere_, task_);
  const Frame second_frame = frame_from(flight, 2);
  const Step second = step(tracker_, second_frame, first.next, task_);
  const Decision expected = decide(second.measured, second_frame.attitude, second_frame.stamp_s,
                                   first.decision.next, task_);
  EXPECT_EQ(second.decision.command.vector(), expected.command.vector());
  EXPECT_EQ(second.decision.state, CommandState::Servo);
  EXPECT_GT(second.decision.command.forward_m_s, 0);
  EXPECT_EQ(second.track.stage, TrackStage::Aligned);  // followed from where the first one saw it
  EXPECT_EQ(second.next.track.window.width, second.track.next.window.width);
  EXPECT_EQ(second.next.pose->translation, second.pose->camera_from_target.translation);
  EXPECT_EQ(second.next.decision.sent.vector(), second.decision.command.vector());
}

TEST_F(StepOfTheLoop, KeepsThePoseAndFadesWhenTheTargetIsGone) {
  const Frame seen = frame_from({{-0.4, 0.2, 0.1}, {}}, 1);
  LoopState state = everywhere_;
  state.decision.stamp_s = 0;
  state = step(tracker_, seen, state, task_).next;
  EXPECT_GT(state.decision.sent.vector().norm(), 0.03);
  const TargetPose pose = *state.pose;
  const auto expect_lost = [&](std::int64_t index, CommandState expected) {
    const Step s = step(tracker_, black(index), state, task_);
    EXPECT_FALSE(s.track.found());
    EXPECT_FALSE(s.pose);
    EXPECT_TRUE(s.measured.empty());
    EXPECT_EQ(s.next.pose->translation, pose.translation);
    EXPECT_EQ(s.decision.state, expected) << index;
    state = s.next;
  };
  expect_lost(2, CommandState::Hold);
  expect_lost(10, CommandState::Decay);
  expect_lost(40, CommandState::Hover);
  EXPECT_EQ(state.decision.sent.vector(), Vector4d::Zero());
  Frame again = seen;
  again.stamp_s = 41 * kFrame;
  const Step found = step(tracker_, again, state, task_);
  EXPECT_EQ(found.decision.state, CommandState::Servo);
  // The rate of 2 m/s^2 over a frame, no jump.
  EXPECT_LE(found.decision.command.forward_m_s, 2 * kFrame + 1e-12);
}

TEST_F(StepOfTheLoop, HoversForFramesThatAreNone) {
  const Frame seen = frame_from({{-0.4, 0, 0}, {}}, 3);
  LoopState state = everywhere_;
  state.decision.stamp_s = 2 * kFrame;
  state = step(tracker_, seen, state, task_).next;
  EXPECT_EQ(state.decision.stamp_s, seen.stamp_s);
  Frame no_image = black(4);
  no_image.gray.release();
  EXPECT_EQ(step(tracker_, no_image, state, task_).decision.state, CommandState::Hold);
  Frame no_stamp = seen;
  no_stamp.stamp_s = kNan;
  const Step s = step(tracker_, no_stamp, state, task_);
  EXPECT_TRUE(s.track.found());
  EXPECT_EQ(s.decision.state, CommandState::Hover);
  EXPECT_EQ(s.decision.command.vector(), Vector4d::Zero());
}

TEST_F(StepOfTheLoop, GivesTheSameBitsTwice) {
  const Frame frame = frame_from({{-0.4, 0.2, 0.1}, {0.1, -0.1, 0.2}}, 1);
  LoopState state = everywhere_;
  state.decision.stamp_s = 0;
  const Step a = step(tracker_, frame, state, task_);
  const Step b = step(tracker_, frame, state, task_);
  EXPECT_GT(a.decision.command.vector().norm(), 0);
  EXPECT_EQ(a.decision.command.vector(), b.decision.command.vector());
  EXPECT_EQ(a.pose->camera_from_target.rotation, b.pose->camera_from_target.rotation);
}

// From pictures to its goal: tracker, pose, law and limits in one.
TEST_F(StepOfTheLoop, BringsTheHelicopterToItsGoal) {
  Flight flight{{-0.5, 0.15, 0.1}, {0, 0, 0.05}};
  Task quick = task_;  // ten frames a second and a gain of 2/s: fewer pictures for the same flight
  quick.servo.gain_per_s = 2;
  LoopState state = everywhere_;
  for (int k = 1; k <= 15; ++k) {
    Frame frame = frame_from(flight, k);
    frame.stamp_s = 0.1 * k;
    const Step s = step(tracker_, frame, state, quick);
    EXPECT_EQ(s.decision.state, CommandState::Servo) << k;
    flight = flight.after(s.decision.command, 0.1);
    state = s.next;
  }
  // 1.4 s of gain 2/s from 0.5 m leave 30 mm, more for the time to get going; sideways and yaw are
  // told apart to about 0.1 m at 0.2 px of noise.
  EXPECT_LT(std::abs(flight.ned.x()), 0.08);
  EXPECT_LT(flight.ned.norm(), 0.15);
}

}  // namespace
}  // namespace kestrel
