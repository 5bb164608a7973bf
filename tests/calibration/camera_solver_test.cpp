#include "kestrel/calibration/camera_solver.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "board_views.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using test::Random;
using ::testing::HasSubstr;

const Board kBoard;  // 9 x 6 corners, 25 mm
constexpr ImageSize kSize{640, 480};
const double kNan = std::numeric_limits<double>::quiet_NaN();

/// A camera and the models that hold it.
struct Case {
  Camera camera;
  CameraModel model;
};

std::vector<Case> cases() {
  return {{test::straight(), CameraModel::None},
          {Camera({540, 538, 331, 236, 640, 480, Lens::PlumbBob, {-0.2, 0, 0, 0, 0}}),
           CameraModel::Radial},
          {test::wide_angle(), CameraModel::RadialTangential},
          {test::wide_angle(), CameraModel::RadialTangential3},
          {test::fisheye(), CameraModel::KannalaBrandt}};
}

// Without noise the truth is the minimum; the step of the least squares ends at rounding.
TEST(SolveCamera, FindsEveryLensExactlyWithoutNoise) {
  for (const Case& c : cases()) {
    Random random(name(c.model));
    const auto poses = test::usual_poses(kBoard, c.camera, 8, random);
    std::vector<BoardView> views;
    for (const TargetPose& pose : poses)
      views.push_back(test::view_of(kBoard, c.camera, pose, 0, random));
    const Calibration found = solve_camera(views, kBoard, kSize, c.model);
    EXPECT_LT(found.rms_px, 1e-6) << name(c.model);
    const std::vector<double> truth = values_of(c.model, c.camera.parameters());
    for (std::size_t i = 0; i < truth.size(); ++i)
      EXPECT_NEAR(found.parameters[i].value, truth[i], 1e-5) << name(c.model) << ' ' << i;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_LT((found.views[i].camera_from_board.translation - poses[i].translation).norm(), 1e-7);
      EXPECT_LT((found.views[i].camera_from_board.rotation - poses[i].rotation).norm(), 1e-6);
    }
  }
}

TEST(SolveCamera, ResidualsAreThoseOfTheNoise) {
  Random random("noise");
  const Camera camera = test::wide_angle();
  const auto views = test::usual_views(kBoard, camera, 10, 0.2, random);
  const Calibration found = solve_camera(views, kBoard, kSize, CameraModel::RadialTangential);
  // 1080 coordinates less 68 unknowns: the noise is known to 2.2 %; 4 sigma.
  EXPECT_NEAR(found.noise_px, 0.2, 0.018);
  EXPECT_NEAR(found.rms_px, 0.2 * std::sqrt(2.0 * (1080 - 68) / 1080), 0.025);
  double sum = 0;
  for (const SolvedView& view : found.views) {
    EXPECT_EQ(view.residuals.size(), 54u);
    EXPECT_GE(view.worst_px, view.rms_px);
    sum += view.rms_px * view.rms_px / double(found.views.size());
  }
  EXPECT_NEAR(std::sqrt(sum), found.rms_px, 1e-12);
}

// The law of the residuals' sign: what the camera puts too far right is positive.
TEST(SolveView, ResidualsArePutLessSeen) {
  Random random("sign");
  const Camera camera = test::straight();
  BoardView view = test::view_of(
      kBoard, camera, test::board_pose_at(kBoard, {0, 0}, 0.4, {0.3, 0.2, 0}), 0, random);
  view.points[20].in_image.u -= 5;
  const SolvedView solved = solve_view(view, kBoard, camera);
  EXPECT_NEAR(solved.residuals[20].du_px, 5, 0.5);
  EXPECT_NEAR(solved.residuals[20].dv_px, 0, 0.3);
  EXPECT_EQ(solved.residuals[20].seen.u, view.points[20].in_image.u);
}

// OpenCV states standard deviations for its own models; they rest on the same Jacobian. OpenCV
// divides by points less unknowns where we count both coordinates, so its figures are larger by
// about the square root of two.
TEST(SolveCamera, DeviationsAreOpenCvs) {
  Random random("deviations");
  const auto views = test::usual_views(kBoard, test::wide_angle(), 10, 0.2, random);
  const Calibration ours = solve_camera(views, kBoard, kSize, CameraModel::RadialTangential);
  std::vector<std::vector<cv::Point3f>> on_board(views.size());
  std::vector<std::vector<cv::Point2f>> seen(views.size());
  const auto points = board_points(kBoard);
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const BoardPoint& p : views[i].points) {
      const Eigen::Vector3d& q = points[std::size_t(p.id)];
      on_board[i].emplace_back(float(q.x()), float(q.y()), 0.F);
      seen[i].emplace_back(float(p.in_image.u), float(p.in_image.v));
    }
  }
  cv::Mat K, lens, deviations, ignored, errors;
  std::vector<cv::Mat> r, t;
  cv::calibrateCamera(on_board, seen, {640, 480}, K, lens, r, t, deviations, ignored, errors,
                      cv::CALIB_FIX_K3);
  for (int i = 0; i < 8; ++i) {
    const double ratio = deviations.at<double>(i) / ours.parameters[std::size_t(i)].deviation;
    const double unknowns = 68;
    const double expected = std::sqrt((1080 - unknowns) / (540 - unknowns));
    EXPECT_NEAR(ratio / expected, 1, 0.05) << i;
  }
  EXPECT_NEAR(ours.parameters[0].value, K.at<double>(0, 0), 0.01);
  EXPECT_NEAR(ours.parameters[2].value, K.at<double>(0, 2), 0.01);
}

TEST(SolveCamera, IsTheSameTwice) {
  Random random("twice");
  const auto views = test::usual_views(kBoard, test::wide_angle(), 6, 0.2, random);
  const Calibration a = solve_camera(views, kBoard, kSize, CameraModel::RadialTangential);
  const Calibration b = solve_camera(views, kBoard, kSize, CameraModel::RadialTangential);
  for (std::size_t i = 0; i < a.parameters.size(); ++i) {
    EXPECT_EQ(a.parameters[i].value, b.parameters[i].value);
    EXPECT_EQ(a.parameters[i].deviation, b.parameters[i].deviation);
  }
}

TEST(SolveCamera, TakesViewsOfAPartOfTheBoard) {
  Random random("part");
  auto views = test::usual_views(kBoard, test::straight(), 8, 0, random);
  for (std::size_t i = 0; i < views.size(); ++i)
    views[i].points.erase(views[i].points.begin(), views[i].points.begin() + std::ptrdiff_t(3 * i));
  const Calibration found = solve_camera(views, kBoard, kSize, CameraModel::None);
  EXPECT_NEAR(found.parameters[0].value, 610, 1e-4);
  EXPECT_EQ(found.views[2].residuals.size(), 48u);
}

class Refused : public ::testing::Test {
 protected:
  Refused() {
    Random random("refused");
    views_ = test::usual_views(kBoard, test::straight(), 5, 0.1, random);
  }
  std::string error() const {
    return message_of([&] { solve_camera(views_, kBoard, kSize, CameraModel::None); });
  }
  std::vector<BoardView> views_;
};

TEST_F(Refused, TooFewViews) {
  views_.resize(2);
  EXPECT_THAT(error(), HasSubstr("seen in 2 pictures only; take 10 to 20"));
}

TEST_F(Refused, AViewOfTooFewPoints) {
  views_[1].points.resize(3);
  EXPECT_THAT(error(), HasSubstr("view 2: only 3 points"));
}

TEST_F(Refused, PointsThatAreNotFinite) {
  views_[2].points[7].in_image.v = kNan;
  EXPECT_THAT(error(), HasSubstr("view 3: a point's place is not finite"));
}

TEST_F(Refused, PointsOutsideTheImage) {
  views_[0].points[7].in_image.u = 641;
  EXPECT_THAT(error(), HasSubstr("outside the 640 x 480 image"));
}

TEST_F(Refused, PointsThatTheBoardHasNot) {
  views_[0].points[7].id = 54;
  EXPECT_THAT(error(), HasSubstr("point 54 is none of the board's 54"));
  views_[0].points[7].id = -1;
  EXPECT_THAT(error(), HasSubstr("point -1"));
}

TEST_F(Refused, ABoardThatIsAlwaysFlatToTheCamera) {
  Random random("flat");
  std::vector<BoardView> flat;
  for (int i = 0; i < 6; ++i) {
    const TargetPose pose =
        test::board_pose_at(kBoard, {0.05 * i - 0.1, 0.02 * i}, 0.4 + 0.02 * i, {0, 0, 0});
    flat.push_back(test::view_of(kBoard, test::straight(), pose, 0, random));
  }
  EXPECT_THAT(message_of([&] { solve_camera(flat, kBoard, kSize, CameraModel::None); }),
              HasSubstr("tilt the board"));
}

TEST(SolveView, HasNoResidualsWhereThereIsNoPose) {
  BoardView nonsense{"a", {{0, {1, 1}}, {1, {2, 2}}, {2, {3, 3}}, {3, {4, 4}}}};
  EXPECT_TRUE(solve_view(nonsense, kBoard, test::straight()).residuals.empty());
}

}  // namespace
}  // namespace kestrel
