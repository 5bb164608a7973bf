#include "bench/stress.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/stress_light.hpp"
#include "bench/stress_motion.hpp"
#include "bench/stress_scene.hpp"
#include "bench/stress_texture.hpp"
#include "bench/stress_view.hpp"

namespace kestrel::test {
namespace {

class Stress : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(stress_texture("graffiti").file)) {
      GTEST_SKIP() << "opencv-doc is not installed";
    }
  }
};

TEST_F(Stress, FirstFrameIsCleanAndStraight) {
  for (const std::string& cls : stress_classes()) {
    const StressSequence sequence = stress_sequence({cls, "box", 1, 1});
    const PixelBox& box = sequence.sequence.template_px;
    const Corners& row = sequence.sequence.truth.at(0);
    EXPECT_NEAR(row[0].u, box.u, 1e-9) << cls;
    EXPECT_NEAR(row[0].v, box.v, 1e-9) << cls;
    EXPECT_NEAR(row[2].u, box.u + box.width - 1, 1e-9) << cls;
    EXPECT_NEAR(row[2].v, box.v + box.height - 1, 1e-9) << cls;
  }
}

TEST_F(Stress, AFrameIsTheSameWhateverWasRenderedBefore) {
  for (const char* cls : {"flight", "noise", "blackout", "occlusion"}) {
    const StressSequence sequence = stress_sequence({cls, "leaves", 24, 5});
    const StressSequence again = stress_sequence({cls, "leaves", 60, 5});
    const cv::Mat a = rendered_frames(sequence).back();
    const cv::Mat b = rendered_frames(again)[23];
    EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0) << cls;
    const cv::Mat other = rendered_frames(stress_sequence({cls, "leaves", 24, 6})).back();
    const bool is_black = std::string(cls) == "blackout";
    EXPECT_EQ(cv::norm(a, other, cv::NORM_INF) == 0, is_black) << cls;
  }
}

/// Fastest corner of each class, px/frame: what the comment in stress.hpp promises, over all
/// textures of the dev set; jumps apart.
TEST_F(Stress, SpeedsArePhysical) {
  const std::map<std::string, std::pair<double, double>> bounds = {
      {"nominal", {2, 6}},        {"scale", {5, 14}}, {"rotation", {6, 14}}, {"tilt", {4, 14}},
      {"blur", {10, 24}},         {"noise", {2, 6}},  {"occlusion", {2, 6}}, {"flight", {5, 16}},
      {"flight_window", {5, 16}}, {"fast", {15, 24}}, {"small", {2, 6}},     {"gust", {15, 32}}};
  for (const auto& [cls, bound] : bounds) {
    double fastest = 0;
    for (const std::string& texture : texture_names(StressSet::Dev)) {
      std::string name = cls;
      name.append("/").append(texture).append("/1");
      const StressMotion motion = stress_motion(cls, name);
      const Homography none;
      for (int k = 1; k < 300; ++k) {
        const auto corner = [&](double t, double x, double y) {
          const Eigen::Vector3d p = motion.at(t).camera_from_target() * Eigen::Vector3d(x, y, 0);
          return Pixel{319.5 + kFocal_px * p.x() / p.z(), 239.5 + kFocal_px * p.y() / p.z()};
        };
        for (const double x : {-0.5, 0.5}) {
          for (const double y : {-0.4, 0.4}) {
            fastest = std::max(fastest, distance(corner(k, x, y), corner(k - 1., x, y)));
          }
        }
      }
    }
    RecordProperty(cls, std::to_string(fastest));
    std::cout << cls << " " << fastest << "\n";
    EXPECT_GT(fastest, bound.first) << cls;
    EXPECT_LT(fastest, bound.second) << cls;
  }
}

/// A frame is stamped at the middle of its exposure.
TEST(StressView, InstantsLieAboutTheFrame) {
  const StressView view{"flight", {206, 154}, stress_motion("flight", "a")};
  for (const std::int64_t k : {0, 5, 70}) {
    const std::vector<double> times = instants(view, k);
    double sum = 0;
    for (const double t : times) sum += t / double(times.size());
    EXPECT_NEAR(sum, double(k), 1e-9);
    EXPECT_LE(times.back() - times.front(), stress_exposure("flight"));
    EXPECT_EQ(times.size() == 1, k == 0);
  }
}

TEST_F(Stress, ClassesReachWhatTheySay) {
  double smallest = 9;
  double largest = 0;
  double most_tilt = 0;
  double most_roll = 0;
  for (int k = 0; k < 150; ++k) {
    const StressPose scaled = stress_motion("scale", "a").at(k);
    smallest = std::min(smallest, scaled.scale);
    largest = std::max(largest, scaled.scale);
    const StressPose tilted = stress_motion("tilt", "a").at(k);
    most_tilt = std::max(most_tilt, std::hypot(tilted.tilt_x, tilted.tilt_y));
    most_roll = std::max(most_roll, std::abs(stress_motion("rotation", "a").at(k).roll));
  }
  EXPECT_LT(smallest, 0.6);
  EXPECT_GT(largest, 1.7);
  EXPECT_GT(most_tilt * 180 / M_PI, 47);  // amplitudes vary from 80 to 100 %
  EXPECT_LE(most_tilt * 180 / M_PI, 60.01);
  EXPECT_GT(most_roll * 180 / M_PI, 140);
}

/// Share of the poster that lies under the occluder, counted on a grid (1 % steps).
TEST_F(Stress, OccluderHidesUpToFortyPercent) {
  const cv::Size px = poster_size("occlusion", {640, 480});
  const double half_m = occluder_side_m(px) / 2;
  double most = 0;
  for (int k = 0; k < 150; ++k) {
    const auto back = occluder_pose(k).inverse();
    int hidden = 0;
    for (int i = 0; i < 2500; ++i) {
      const int row = i / 50;
      const Eigen::Vector3d p(((i % 50 + 0.5) / 50 - 0.5) * px.width / kPxPerMetre,
                              ((row + 0.5) / 50 - 0.5) * px.height / kPxPerMetre, 0);
      const Eigen::Vector3d q = back * p;
      hidden += std::abs(q.x()) < half_m && std::abs(q.y()) < half_m ? 1 : 0;
    }
    most = std::max(most, hidden / 2500.);
    EXPECT_TRUE(k > 0 || hidden == 0);
  }
  EXPECT_GT(most, 0.39);
  EXPECT_LT(most, 0.41);
}

TEST_F(Stress, BlackoutsHaveNoTruthAndOthersAllOfIt) {
  const StressSequence dark = stress_sequence({"blackout", "box", 150, 1});
  EXPECT_EQ(dark.absent.size(), 60u);
  for (const std::int64_t k : dark.absent) EXPECT_EQ(dark.sequence.truth.count(k), 0u);
  for (const char* cls : {"nominal", "tilt", "occlusion"}) {
    const StressSequence whole = stress_sequence({cls, "box", 150, 1});
    EXPECT_TRUE(whole.absent.empty());
    EXPECT_EQ(whole.sequence.truth.size(), 150u) << cls;
  }
}

TEST_F(Stress, AbsentFramesDoNotShowTheTarget) {
  const StressSequence dark = stress_sequence({"blackout", "box", 150, 1});
  const std::vector<cv::Mat> frames = rendered_frames(dark);
  const cv::Mat learned = frames[0](
      cv::Rect(int(dark.sequence.template_px.u), int(dark.sequence.template_px.v), 120, 120));
  for (const std::int64_t k : {20, 50, 80, 110, 140}) {
    EXPECT_EQ(dark.absent.count(k), 1u);
    double low = 0;
    double high = 0;
    cv::minMaxLoc(frames[std::size_t(k)], &low, &high);
    if (low == high) continue;  // black, white, grey
    cv::Mat score;
    cv::matchTemplate(frames[std::size_t(k)], learned, score, cv::TM_CCOEFF_NORMED);
    double best = 0;
    cv::minMaxLoc(score, nullptr, &best);
    EXPECT_LT(best, 0.7) << k;
  }
}

TEST_F(Stress, OptionsAreChecked) {
  EXPECT_THROW(stress_sequence({"nonsense", "box", 1, 1}), std::invalid_argument);
  EXPECT_THROW(stress_sequence({"nominal", "nonsense", 1, 1}), std::invalid_argument);
  EXPECT_THROW(stress_sequence({"nominal", "box", 0, 1}), std::invalid_argument);
  EXPECT_THROW(load_picture("/nowhere.png"), std::runtime_error);
}

}  // namespace
}  // namespace kestrel::test
