#include "kestrel/io/task_options.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kDegree = M_PI / 180;

class TaskOptions : public ::testing::Test {
 protected:
  Section load(const std::string& text) { return Section::load(folder_.write("t.yaml", text)); }
  template <class Read>
  std::string error_of(const std::string& text, Read read) {
    return test::message_of([&] { read(load(text)); });
  }
  test::TempFolder folder_;
};

TEST_F(TaskOptions, KeepTheDefaultsOfTheStructs) {
  for (const char* text : {"x: 1\n",
                           "track: {sift: {}, match: {}, ransac: {}, outline: {}}\n"
                           "pose: {}\nservo: {}\nlimits: {speed: {}, acceleration: {}}\n"
                           "loss: {}\n"}) {
    const Section root = load(text);
    EXPECT_EQ(read_track_options(root).ransac.max_trials, RansacOptions().max_trials);
    EXPECT_EQ(read_track_options(root).sift.sigma, SiftOptions().sigma);
    EXPECT_EQ(read_pose_options(root).corner_noise_px, PlanePoseOptions().corner_noise_px);
    EXPECT_EQ(read_servo_options(root).gain_per_s, ServoOptions().gain_per_s);
    EXPECT_EQ(read_loss_options(root).decay_s, LossOptions().decay_s);
    // Degrees and back: a rounding.
    EXPECT_NEAR(read_command_limits(root).speed.yaw_rate_rad_s,
                CommandLimits().speed.yaw_rate_rad_s, 1e-15);
    EXPECT_EQ(read_command_limits(root).acceleration.down_m_s,
              CommandLimits().acceleration.down_m_s);
  }
}

// Every number is another one, so that no two keys can be mixed up.
TEST_F(TaskOptions, PutEveryTrackKeyInItsPlace) {
  const Section root = load(
      "track:\n"
      "  sift: {octave_layers: 4, contrast_threshold: 0.05, edge_threshold: 11, sigma_px: 1.7,"
      " max_keypoints: 1234}\n"
      "  match: {ratio: 0.7, checks: 99, seed: 5}\n"
      "  ransac: {max_reprojection_px: 2.5, min_inliers: 9, min_inlier_share: 0.2,"
      " max_trials: 777, confidence: 0.98, seed: 6}\n"
      "  outline: {min_area_ratio: 0.1, max_area_ratio: 20, min_side_px: 8}\n"
      "  max_outline_deviation_px: 2.25\n");
  const TrackOptions o = read_track_options(root);
  EXPECT_EQ(o.sift.octave_layers, 4);
  EXPECT_EQ(o.sift.contrast_threshold, 0.05);
  EXPECT_EQ(o.sift.edge_threshold, 11);
  EXPECT_EQ(o.sift.sigma, 1.7);
  EXPECT_EQ(o.sift.max_keypoints, 1234);
  EXPECT_EQ(o.match.ratio, 0.7);
  EXPECT_EQ(o.match.checks, 99);
  EXPECT_EQ(o.match.seed, 5);
  EXPECT_EQ(o.ransac.max_reprojection_px, 2.5);
  EXPECT_EQ(o.ransac.min_inliers, 9);
  EXPECT_EQ(o.ransac.min_inlier_share, 0.2);
  EXPECT_EQ(o.ransac.max_trials, 777);
  EXPECT_EQ(o.ransac.confidence, 0.98);
  EXPECT_EQ(o.ransac.seed, 6u);
  EXPECT_EQ(o.outline.min_area_ratio, 0.1);
  EXPECT_EQ(o.outline.max_area_ratio, 20);
  EXPECT_EQ(o.outline.min_side_px, 8);
  EXPECT_EQ(o.max_outline_deviation_px, 2.25);
  EXPECT_NO_THROW(root.done());
}

TEST_F(TaskOptions, PutEveryOtherKeyInItsPlace) {
  const Section root = load(
      "pose: {corner_noise_px: 0.7}\n"
      "servo: {interaction: desired, freedom: three, gain_per_s: 0.9}\n"
      "limits:\n"
      "  speed: {forward_m_s: 1, right_m_s: 2, down_m_s: 3, yaw_rate_deg_s: 40}\n"
      "  acceleration: {forward_m_s2: 5, right_m_s2: 6, down_m_s2: 7, yaw_rate_deg_s2: 80}\n"
      "loss: {hold_s: 0.2, decay_s: 0.3, hover_after_s: 1.5}\n");
  EXPECT_EQ(read_pose_options(root).corner_noise_px, 0.7);
  const ServoOptions servo = read_servo_options(root);
  EXPECT_EQ(servo.law, Law::Des);
  EXPECT_EQ(servo.freedom, Freedom::Three);
  EXPECT_EQ(servo.gain_per_s, 0.9);
  const CommandLimits limits = read_command_limits(root);
  EXPECT_TRUE(limits.speed.vector().isApprox(Eigen::Vector4d(1, 2, 3, 40 * kDegree)));
  EXPECT_TRUE(limits.acceleration.vector().isApprox(Eigen::Vector4d(5, 6, 7, 80 * kDegree)));
  const LossOptions loss = read_loss_options(root);
  EXPECT_EQ(loss.hold_s, 0.2);
  EXPECT_EQ(loss.decay_s, 0.3);
  EXPECT_EQ(loss.hover_after_s, 1.5);
  EXPECT_NO_THROW(root.done());
}

TEST_F(TaskOptions, NameEveryWordOfAChoice) {
  const auto servo_of = [&](const std::string& keys) {
    return read_servo_options(load("servo: {" + keys + "}\n"));
  };
  EXPECT_EQ(servo_of("interaction: current").law, Law::Cur);
  EXPECT_EQ(servo_of("interaction: mean").law, Law::Mean);
  EXPECT_EQ(servo_of("freedom: six").freedom, Freedom::Six);
  EXPECT_EQ(servo_of("freedom: four").freedom, Freedom::Four);
  EXPECT_THAT(
      error_of("servo: {interaction: average}\n", read_servo_options),
      HasSubstr("t.yaml:1: servo.interaction: is 'average'; write current, desired or mean"));
}

TEST_F(TaskOptions, ReadEveryLawAndItsNumbers) {
  for (const Law law : all_laws()) {
    const Section root = load("servo: {law: " + std::string(name(law)) + "}\n");
    EXPECT_EQ(read_servo_options(root).law, law);
  }
  const Section root = load(
      "servo: {law: rls, gain_per_s: 4, far_gain_per_s: 0.4, gain_slope_per_s: 20,\n"
      "  smooth_start_per_s: 3, damping: 0.1, learning_gate: 0.02, forgetting: 0.9,\n"
      "  initial_covariance: 7}\n");
  const ServoOptions o = read_servo_options(root);
  EXPECT_EQ(o.far_gain_per_s, 0.4);
  EXPECT_EQ(o.gain_slope_per_s, 20);
  EXPECT_EQ(o.smooth_start_per_s, 3);
  EXPECT_EQ(o.damping, 0.1);
  EXPECT_EQ(o.learning_gate, 0.02);
  EXPECT_EQ(o.forgetting, 0.9);
  EXPECT_EQ(o.initial_covariance, 7);
  EXPECT_NO_THROW(root.done());
  EXPECT_THAT(error_of("servo: {law: mean, interaction: mean}\n", read_servo_options),
              HasSubstr("t.yaml:1: servo.interaction: stands beside law"));
  EXPECT_THAT(error_of("servo: {law: best}\n", read_servo_options),
              HasSubstr("t.yaml:1: servo.law: is 'best'; write cur, "));
}

TEST_F(TaskOptions, PutEveryCaptureKeyInItsPlace) {
  const Section root = load(
      "capture: {format: yuyv, size_px: [752, 480], rate_hz: 60, exposure_s: 0.004, gain: 12,\n"
      "  trigger: {source: software, mode: 14, polarity: low},\n"
      "  open_timeout_s: 1, stall_timeout_s: 2.5, blind_s: 0.3, give_up_s: 40, retry_s: 0.5,\n"
      "  longest_retry_s: 6}\n");
  const LiveOptions o = read_live_options(root);
  EXPECT_EQ(o.capture.format, "yuyv");
  EXPECT_EQ(o.capture.size, cv::Size(752, 480));
  EXPECT_EQ(o.capture.rate_hz, 60);
  EXPECT_EQ(o.capture.exposure_s, 0.004);
  EXPECT_EQ(o.capture.gain, 12);
  ASSERT_TRUE(o.capture.trigger.has_value());
  EXPECT_EQ(o.capture.trigger->source, "software");
  EXPECT_EQ(o.capture.trigger->mode, 14);
  EXPECT_EQ(o.capture.trigger->polarity, "low");
  EXPECT_EQ(o.open_timeout_s, 1);
  EXPECT_EQ(o.stall_timeout_s, 2.5);
  EXPECT_EQ(o.blind_s, 0.3);
  EXPECT_EQ(o.give_up_s, 40);
  EXPECT_EQ(o.retry_s, 0.5);
  EXPECT_EQ(o.longest_retry_s, 6);
  EXPECT_NO_THROW(root.done());
}

TEST_F(TaskOptions, RefuseACaptureThatNoCameraHas) {
  const auto error = [this](const std::string& keys) {
    return error_of("capture: {" + keys + "}\n", [](const Section& root) {
      read_live_options(root);
      root.done();
    });
  };
  EXPECT_THAT(error("size_px: [640, 0]"), HasSubstr("capture.size_px: is no image size"));
  EXPECT_THAT(error("rate_hz: -1"), HasSubstr("rate_hz: must be positive"));
  EXPECT_THAT(error("blind_s: 0"), HasSubstr("blind_s: must be positive"));
  EXPECT_THAT(error("trigger: {source: 7}"), HasSubstr("trigger.source: must be 0, 1, 2, 3"));
  EXPECT_THAT(error("trigger: {delay: 7}"), HasSubstr("trigger.delay"));
  EXPECT_THAT(error("exposure: 1"), AllOf(HasSubstr("exposure"), HasSubstr("exposure_s")));
}

TEST_F(TaskOptions, ReadTheTiming) {
  const Section root = load(
      "timing: {predict: commanded, gain_share: 0.5, latency_s: 0.2, velocity_time_constant_s: 1,\n"
      "  tilt_time_constant_s: 0.2, vertical_time_constant_s: 0.6, yaw_time_constant_s: 0.7}\n");
  const TimingOptions o = read_timing_options(root);
  EXPECT_NO_THROW(root.done());
  EXPECT_EQ(o.predict, Prediction::Commanded);
  EXPECT_EQ(o.gain_share, 0.5);
  EXPECT_EQ(o.latency_s, 0.2);
  EXPECT_EQ(o.response.velocity_s, 1);
  EXPECT_EQ(o.response.tilt_s, 0.2);
  EXPECT_EQ(o.response.vertical_s, 0.6);
  EXPECT_EQ(o.response.yaw_s, 0.7);
  const TimingOptions none = read_timing_options(load("a: 1\n"));
  EXPECT_EQ(none.predict, Prediction::Off);
  EXPECT_FALSE(none.latency_s);
  EXPECT_THAT(error_of("timing: {gain_share: 0}\n", read_timing_options),
              AllOf(HasSubstr("t.yaml:1: timing: "), HasSubstr("gain_share")));
}

TEST_F(TaskOptions, NameTheSectionOfAnOptionOutOfRange) {
  EXPECT_THAT(error_of("a: 1\nservo: {gain_per_s: -1}\n", read_servo_options),
              AllOf(HasSubstr("t.yaml:2: servo: "), HasSubstr("gain_per_s")));
  EXPECT_THAT(error_of("track:\n  match: {ratio: 2}\n", read_track_options),
              AllOf(HasSubstr("t.yaml:2: track.match: "), HasSubstr("ratio")));
  EXPECT_THAT(error_of("track:\n  ransac: {max_trials: 0}\n", read_track_options),
              AllOf(HasSubstr("t.yaml:2: track.ransac: "), HasSubstr("max_trials")));
  EXPECT_THAT(error_of("track:\n  ransac: {seed: -1}\n", read_track_options),
              HasSubstr("t.yaml:2: track.ransac.seed: is negative"));
  EXPECT_THAT(error_of("track:\n  sift: {max_keypoints: 0}\n", read_track_options),
              HasSubstr("t.yaml:2: track.sift: "));
  EXPECT_THAT(error_of("limits:\n  speed: {down_m_s: 0}\n", read_command_limits),
              HasSubstr("t.yaml:1: limits: "));
  EXPECT_THAT(error_of("loss: {hold_s: -1}\n", read_loss_options), HasSubstr("t.yaml:1: loss: "));
  EXPECT_THAT(error_of("pose: {corner_noise_px: -1}\n", read_pose_options),
              HasSubstr("t.yaml:1: pose: "));
}

TEST_F(TaskOptions, RefuseKeysOfOtherSectionsAndUnits) {
  const Section root = load("limits:\n  speed: {yaw_rate_rad_s: 1}\n");
  read_command_limits(root);
  EXPECT_THAT(test::message_of([&] { root.done(); }),
              HasSubstr("t.yaml:2: limits.speed.yaw_rate_rad_s: is no key here; did you mean "
                        "yaw_rate_deg_s?"));
}

}  // namespace
}  // namespace kestrel
