#include "kestrel/ground/ground_desk.hpp"

#include <gtest/gtest.h>

#include "ground/desk_viewer.hpp"

namespace kestrel {
namespace {

using test::Desk;

TEST_F(Desk, StandsStillUntilTheCommanderStarts) {
  EXPECT_EQ(desk_.mode(), FlightMode::Hover);
  EXPECT_FALSE(gate_.is_open());
  EXPECT_EQ(desk_.handle(asked(Ask::Start, second_), 0).answer.kind, Answer::Kind::Refused);
  EXPECT_FALSE(gate_.is_open());
  EXPECT_EQ(give(Ask::Start).kind, Answer::Kind::Done);
  EXPECT_EQ(desk_.mode(), FlightMode::Servo);
  EXPECT_TRUE(gate_.is_open());
}

TEST_F(Desk, AnybodyStopsAtOnce) {
  give(Ask::Start);
  gate_.send({1, 0, 0, 0}, 1);
  EXPECT_EQ(desk_.handle(asked(Ask::Hover, ""), 0).answer.kind, Answer::Kind::Done);
  ASSERT_EQ(written_.all.size(), 2u);
  EXPECT_TRUE(written_.all[1].vector().isZero(0));
  give(Ask::Start);
  EXPECT_EQ(desk_.handle(asked(Ask::Abort, "a stranger"), 0).answer.kind, Answer::Kind::Done);
  EXPECT_FALSE(gate_.is_open());
  EXPECT_EQ(give(Ask::Start).kind, Answer::Kind::Refused);
  EXPECT_FALSE(gate_.is_open());
  EXPECT_EQ(give(Ask::Reset).kind, Answer::Kind::Done);
  EXPECT_FALSE(gate_.is_open()) << "reset is no start";
  EXPECT_EQ(desk_.mode(), FlightMode::Hover);
}

TEST_F(Desk, AReplayedStartIsRefused) {
  const GroundCommand start = asked(Ask::Start, first_);
  EXPECT_EQ(desk_.handle(start, 0).answer.kind, Answer::Kind::Done);
  desk_.handle(asked(Ask::Hover, ""), 0);
  EXPECT_EQ(desk_.handle(start, 0).answer.kind, Answer::Kind::Stale);
  EXPECT_EQ(desk_.mode(), FlightMode::Hover);
}

TEST_F(Desk, TheGainStaysWithinTheTasks) {
  GroundCommand gain = asked(Ask::Gain, first_);
  gain.gain_per_s = task_.servo.gain_per_s * 1.01;
  EXPECT_EQ(desk_.handle(gain, 0).answer.kind, Answer::Kind::Refused);
  EXPECT_FALSE(desk_.course());
  gain.number = ++number_;
  gain.gain_per_s = task_.servo.gain_per_s / 2;
  EXPECT_EQ(desk_.handle(gain, 0).answer.kind, Answer::Kind::Done);
  const auto course = desk_.course();
  ASSERT_TRUE(course);
  EXPECT_EQ(course->task.servo.gain_per_s, task_.servo.gain_per_s / 2);
  EXPECT_FALSE(course->tracker);
  EXPECT_FALSE(desk_.course()) << "once";
}

TEST_F(Desk, HoldsTheViewThatIsSeen) {
  EXPECT_EQ(give(Ask::HoldView).kind, Answer::Kind::Refused);
  show(0, std::nullopt);
  EXPECT_EQ(give(Ask::HoldView).kind, Answer::Kind::Refused);
  TargetPose seen = task_.goal;
  seen.translation += Eigen::Vector3d(0.1, -0.05, 0.4);
  show(1, seen);
  EXPECT_EQ(give(Ask::HoldView).kind, Answer::Kind::Done);
  const auto course = desk_.course();
  ASSERT_TRUE(course);
  EXPECT_EQ(course->task.goal.translation, seen.translation);
}

TEST_F(Desk, AGoalThatTheTaskRefusesChangesNothing) {
  TargetPose behind = task_.goal;
  behind.translation = -behind.translation;
  show(0, behind);
  const Answer answer = give(Ask::HoldView);
  EXPECT_EQ(answer.kind, Answer::Kind::Refused);
  EXPECT_NE(answer.words.find("goal"), std::string::npos);
  EXPECT_FALSE(desk_.course());
}

TEST_F(Desk, ATemplateIsDrawnExaminedAndUsed) {
  show(7, task_.goal);
  give(Ask::Start);
  GroundCommand use = asked(Ask::Use, first_);
  use.width_m = 0.5;
  EXPECT_EQ(desk_.handle(use, 0).answer.kind, Answer::Kind::Refused) << "nothing was drawn";
  GroundCommand freeze = asked(Ask::Freeze, first_);
  freeze.frame = 7;
  ASSERT_EQ(desk_.handle(freeze, 0).answer.kind, Answer::Kind::Done);
  GroundCommand examine = asked(Ask::Examine, first_);
  const int width = picture().cols / 4;
  const int height = picture().rows / 4;
  examine.box = PixelBox{double((picture().cols - width) / 2),
                         double((picture().rows - height) / 2), double(width), double(height)};
  const Reply seen = desk_.handle(examine, 0);
  ASSERT_EQ(seen.answer.kind, Answer::Kind::Done) << seen.answer.words;
  ASSERT_TRUE(seen.verdict);
  // Seen from the front, px and m are in the ratio of focal length and distance.
  const double m_per_px = task_.goal.translation.z() / task_.camera.parameters().px;
  EXPECT_NEAR(*seen.width_m, width * m_per_px, 1e-9);
  EXPECT_FALSE(desk_.course()) << "an examination is no choice";
  use.number = ++number_;
  use.width_m = *seen.width_m;
  ASSERT_EQ(desk_.handle(use, 0).answer.kind, Answer::Kind::Done);
  EXPECT_EQ(desk_.mode(), FlightMode::Hover) << "a new template is a doubt";
  const auto course = desk_.course();
  ASSERT_TRUE(course && course->tracker);
  EXPECT_EQ(course->tracker->model().width(), width);
  EXPECT_NEAR(course->task.target_height_m, *seen.width_m * height / width, 1e-9);
  // The goal is the place it was drawn from: on the axis, as far as the target.
  EXPECT_NEAR(course->task.goal.translation.z(), task_.goal.translation.z(), 0.01);
}

/// Through a lens: drawn beside the middle, where the lens bends it by several pixels, the goal is
/// where the camera is, as the law will measure it in the next frame.
TEST_F(Desk, ATemplateDrawnThroughALensIsHeldWhereItWasDrawn) {
  Task task = task_;
  CameraParameters bent = task.camera.parameters();
  bent.lens = Lens::PlumbBob;
  bent.distortion = {-0.28, 0.08, 0, 0, 0};
  task.camera = Camera(bent);
  task.track.lens = task.camera;
  GroundDesk desk(task, gate_, "lens");
  const std::string who = desk.handle(asked(Ask::Join, ""), 0).client;
  ASSERT_EQ(desk.handle(asked(Ask::Take, who), 0).answer.kind, Answer::Kind::Done);
  auto view = std::make_shared<GroundView>();
  view->row.frame = 1;
  view->gray = picture();
  desk.show(view);
  GroundCommand freeze = asked(Ask::Freeze, who);
  freeze.frame = 1;
  ASSERT_EQ(desk.handle(freeze, 0).answer.kind, Answer::Kind::Done);
  GroundCommand examine = asked(Ask::Examine, who);
  const double side = std::floor(picture().rows * 0.4);
  examine.box = PixelBox{std::floor(picture().cols * 0.6), 10, side, side};
  const Reply seen = desk.handle(examine, 0);
  ASSERT_EQ(seen.answer.kind, Answer::Kind::Done) << seen.answer.words;
  GroundCommand use = asked(Ask::Use, who);
  use.width_m = 1;
  const Answer used = desk.handle(use, 0).answer;
  ASSERT_EQ(used.kind, Answer::Kind::Done) << used.words;
  auto course = desk.course();
  ASSERT_TRUE(course && course->tracker);
  Frame frame;
  frame.gray = picture();
  const Track track =
      course->tracker->track(frame, course->tracker->start(frame.gray.cols, frame.gray.rows));
  ASSERT_TRUE(track.found());
  const auto straight = straight_view(track, side, side, task.camera);
  ASSERT_TRUE(straight);
  const PlaneSize size{side, side, course->task.target_width_m, course->task.target_height_m};
  const auto pose = plane_pose(straight->image_from_template, size, straight->camera, std::nullopt);
  ASSERT_TRUE(pose);
  // A tenth of a pixel on a side of some 100 px is 0.1 % of the distance and of a turn's sine 1 %.
  const TargetPose& goal = course->task.goal;
  const TargetPose here = levelled(pose->camera_from_target, std::nullopt, task.body_from_camera);
  EXPECT_LT((here.translation - goal.translation).norm(), 0.02 * goal.translation.norm());
  EXPECT_LT((here.rotation.transpose() * goal.rotation - Eigen::Matrix3d::Identity()).norm(), 0.05);
}

TEST_F(Desk, AnOldPictureAndABadRectangleAreRefused) {
  for (int i = 0; i <= int(GroundDesk::kKeptViews); ++i) show(i, std::nullopt);
  GroundCommand freeze = asked(Ask::Freeze, first_);
  freeze.frame = 0;
  EXPECT_EQ(desk_.handle(freeze, 0).answer.kind, Answer::Kind::Refused);
  freeze = asked(Ask::Freeze, first_);
  freeze.frame = 1;
  EXPECT_EQ(desk_.handle(freeze, 0).answer.kind, Answer::Kind::Done);
  GroundCommand examine = asked(Ask::Examine, first_);
  examine.box = PixelBox{-5, 0, 100, 100};
  const Reply reply = desk_.handle(examine, 0);
  EXPECT_EQ(reply.answer.kind, Answer::Kind::Refused);
  EXPECT_NE(reply.answer.words.find("inside"), std::string::npos);
  EXPECT_FALSE(reply.verdict);
}

TEST_F(Desk, ASilentCommanderLosesTheCommandAndAllAreTold) {
  give(Ask::Start);
  desk_.look_after(CommandPost::kSilence_s + 1);
  const DeskStatus status = desk_.status();
  EXPECT_EQ(status.commander, "");
  EXPECT_EQ(status.mode, FlightMode::Servo);
  ASSERT_FALSE(status.events.empty());
  EXPECT_NE(status.events.back().words.find("silent"), std::string::npos);
}

}  // namespace
}  // namespace kestrel
