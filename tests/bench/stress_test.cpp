#include "bench/stress.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/stress_motion.hpp"
#include "bench/stress_scene.hpp"
#include "bench/stress_texture.hpp"

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

std::vector<cv::Mat> frames_of(const StressSequence& sequence) {
  std::vector<cv::Mat> frames;
  const auto source = sequence.sequence.open();
  while (const auto frame = source->next()) frames.push_back(frame->gray.clone());
  return frames;
}

cv::Mat frame_of(const StressSequence& sequence, std::int64_t index) {
  const auto source = sequence.sequence.open();
  while (const auto frame = source->next()) {
    if (frame->index == index) return frame->gray;
  }
  return {};
}

Homography truth_homography(const StressSequence& sequence, std::int64_t frame) {
  const PixelBox& box = sequence.sequence.template_px;
  const auto corners = template_corners(box.width, box.height);
  std::vector<PixelPair> pairs;
  for (std::size_t i = 0; i < 4; ++i) {
    pairs.push_back({corners[i], sequence.sequence.truth.at(frame)[i]});
  }
  return fit_homography(pairs).value();
}

/// Bilinear value; NaN outside.
double value_at(const cv::Mat& gray, const Pixel& p) {
  const int i = int(std::floor(p.u));
  const int j = int(std::floor(p.v));
  if (i < 0 || j < 0 || i + 1 >= gray.cols || j + 1 >= gray.rows) return std::nan("");
  const double a = p.u - i;
  const double b = p.v - j;
  const auto grey = [&](int y, int x) { return double(gray.at<uchar>(y, x)); };
  return (1 - b) * ((1 - a) * grey(j, i) + a * grey(j, i + 1)) +
         b * ((1 - a) * grey(j + 1, i) + a * grey(j + 1, i + 1));
}

/// Where the frame truly shows the template, as eight parameters of a homography about the truth
/// say that are fitted to the grey levels (Gauss-Newton on all pixels, gain and bias free): mean
/// distance of the corners from the truth, px.
double dense_error_px(const cv::Mat& learned, const PixelBox& box, const cv::Mat& frame,
                      const Homography& truth) {
  Eigen::Matrix3d H = truth.H / truth.H(2, 2);
  const Eigen::Vector3d scale(box.width, box.height, 1);
  for (int step = 0; step < 6; ++step) {
    Eigen::Matrix<double, 10, 10> A = Eigen::Matrix<double, 10, 10>::Zero();
    Eigen::Matrix<double, 10, 1> b = Eigen::Matrix<double, 10, 1>::Zero();
    for (int y = 3; y < int(box.height) - 3; ++y) {
      for (int x = 3; x < int(box.width) - 3; ++x) {
        const Eigen::Vector3d q = H * Eigen::Vector3d(x, y, 1);
        const Pixel p{q.x() / q.z(), q.y() / q.z()};
        const double grey = value_at(frame, p);
        const double gu = (value_at(frame, {p.u + 0.5, p.v}) - value_at(frame, {p.u - 0.5, p.v}));
        const double gv = (value_at(frame, {p.u, p.v + 0.5}) - value_at(frame, {p.u, p.v - 0.5}));
        if (!std::isfinite(grey + gu + gv)) continue;
        const double T = learned.at<uchar>(int(box.v) + y, int(box.u) + x);
        const double gw = -(gu * p.u + gv * p.v);
        const double xs = x / scale.x();
        const double ys = y / scale.y();
        Eigen::Matrix<double, 10, 1> j;
        j << gu * xs, gu * ys, gu, gv * xs, gv * ys, gv, gw * xs, gw * ys, -T / 128, -1;
        j.head<8>() /= q.z();
        A += j * j.transpose();
        b += j * (T - grey);
      }
    }
    const Eigen::Matrix<double, 10, 1> d = A.ldlt().solve(b);
    Eigen::Matrix3d dH;
    dH << d[0] / scale.x(), d[1] / scale.y(), d[2], d[3] / scale.x(), d[4] / scale.y(), d[5],
        d[6] / scale.x(), d[7] / scale.y(), 0;
    H += dH;
  }
  double sum = 0;
  const auto fitted = outline({H}, box.width, box.height);
  const auto wanted = outline(truth, box.width, box.height);
  for (std::size_t i = 0; i < 4; ++i) sum += distance(fitted[i], wanted[i]) / 4;
  return sum;
}

/// The truth is where the picture is: dense alignment of all pixels, whose own error is below
/// 0.01 px with this many pixels of grey noise 1.5 and its bilinear interpolation.
TEST_F(Stress, TruthIsWhereThePictureIs) {
  for (const char* texture : {"graffiti", "board", "aerial"}) {
    const StressSequence sequence = stress_sequence({"nominal", texture, 40, 3});
    const std::vector<cv::Mat> frames = frames_of(sequence);
    for (const std::int64_t k : {9, 21, 38}) {
      EXPECT_LT(dense_error_px(frames[0], sequence.sequence.template_px, frames[std::size_t(k)],
                               truth_homography(sequence, k)),
                0.02)
          << texture << " frame " << k;
    }
  }
}

/// Blur moves no centroid: with an open shutter the truth is the mean over the exposure.
TEST_F(Stress, TruthOfABlurredFrameIsItsMean) {
  const StressSequence sequence = stress_sequence({"flight", "board", 30, 2});
  const std::vector<cv::Mat> frames = frames_of(sequence);
  for (const std::int64_t k : {7, 14, 29}) {
    EXPECT_LT(dense_error_px(frames[0], sequence.sequence.template_px, frames[std::size_t(k)],
                             truth_homography(sequence, k)),
              0.1)
        << k;
  }
}

/// Mean light over each pixel by 9 x 9 rays, through the homography only (none of the renderer's
/// geometry); NaN where a ray leaves the poster.
cv::Mat supersampled(const cv::Mat& poster, const PixelBox& box, const Homography& truth) {
  const Eigen::Matrix3d back = truth.H.inverse();
  cv::Mat light(480, 640, CV_32F);
  for (int v = 0; v < light.rows; ++v) {
    for (int u = 0; u < light.cols; ++u) {
      double grey = 0;
      for (int i = 0; i < 81 && std::isfinite(grey); ++i) {
        const Eigen::Vector3d q =
            back * Eigen::Vector3d(u + (i % 9 - 4) / 9., v + (double(i / 9) - 4) / 9., 1);
        grey += value_at(poster, {(q.x() / q.z() + 0.5) / box.width * poster.cols - 0.5,
                                  (q.y() / q.z() + 0.5) / box.height * poster.rows - 0.5}) /
                81;
      }
      light.at<float>(v, u) = float(grey);
    }
  }
  return light;
}

/// How a frame differs from a picture of the same: the shift of least squares (px), and what is
/// left, as a share of the picture's contrast.
struct Difference {
  double shift_px = 0;
  double residual = 0;
  int pixels = 0;
};

Difference difference(const cv::Mat& frame, const cv::Mat& wanted) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double sum = 0;
  double squares = 0;
  double contrast = 0;
  Difference result;
  for (int v = 1; v + 1 < frame.rows; ++v) {
    for (int u = 1; u + 1 < frame.cols; ++u) {
      const auto w = [&](int y, int x) { return double(wanted.at<float>(y, x)); };
      const Eigen::Vector3d g((w(v, u + 1) - w(v, u - 1)) / 2, (w(v + 1, u) - w(v - 1, u)) / 2, 1);
      const double d = frame.at<uchar>(v, u) - w(v, u);
      if (!std::isfinite(g.sum() + d)) continue;
      A += g * g.transpose();
      b += d * g;
      squares += d * d;
      sum += w(v, u);
      contrast += w(v, u) * w(v, u);
      ++result.pixels;
    }
  }
  const Eigen::Vector3d x = A.ldlt().solve(b);
  const double n = result.pixels;
  result.shift_px = x.head<2>().norm();
  result.residual = std::sqrt((squares - x.dot(b)) / (contrast - sum * sum / n));
  return result;
}

/// A frame is the mean light over each pixel, in the right place, also where the view is oblique or
/// small. The renderer's filter is up to 9 % wider than a pixel, and smoother than a square: on a
/// picture as sharp as this circuit board that leaves a tenth of the contrast; taps of the texture
/// without averaging would leave half of it.
TEST_F(Stress, FrameIsTheSupersampledPoster) {
  const cv::Mat poster = load_picture(stress_texture("board").file);
  for (const auto& [cls, k] :
       std::vector<std::pair<std::string, int>>{{"tilt", 30}, {"scale", 38}, {"nominal", 17}}) {
    const StressSequence sequence = stress_sequence({cls, "board", k + 1, 1});
    const cv::Mat wanted =
        supersampled(poster, sequence.sequence.template_px, truth_homography(sequence, k));
    const Difference found = difference(frame_of(sequence, k), wanted);
    ASSERT_GT(found.pixels, 3000);
    EXPECT_LT(found.shift_px, 0.02) << cls;
    EXPECT_LT(found.residual, 0.12) << cls;
  }
}

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
    const cv::Mat a = frames_of(sequence).back();
    const cv::Mat b = frame_of(again, 23);
    EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0) << cls;
    const cv::Mat other = frame_of(stress_sequence({cls, "leaves", 24, 6}), 23);
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
      {"flight_window", {5, 16}}, {"fast", {15, 24}}, {"small", {2, 6}}};
  for (const auto& [cls, bound] : bounds) {
    double fastest = 0;
    for (const std::string& texture : texture_names(StressSet::Dev)) {
      const StressMotion motion = stress_motion(cls, cls + "/" + texture + "/1");
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
  const std::vector<cv::Mat> frames = frames_of(dark);
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
