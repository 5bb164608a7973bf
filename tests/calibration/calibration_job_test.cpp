#include "kestrel/calibration/calibration_job.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "board_views.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

CalibrationJob job_of(const Camera& camera, CameraModel model, int views) {
  test::Random random("job");
  CalibrationJob job;
  job.board = parse_board("chessboard:7x5:0.03");
  job.model = model;
  job.size = {640, 480};
  job.views = test::usual_views(job.board, camera, views, 0.2, random);
  return job;
}

TEST(Calibrated, AcceptsGoodViewsAndKnowsAllOfThem) {
  const CalibrationResult result =
      calibrated(job_of(test::wide_angle(), CameraModel::RadialTangential, 12));
  ASSERT_TRUE(result.calibration.has_value());
  EXPECT_FALSE(is_refused(result.objections));
  EXPECT_TRUE(result.hold_out.has_value());
  EXPECT_TRUE(result.visp.has_value());
  EXPECT_GT(result.coverage.share, 0.5);
  EXPECT_NEAR(result.calibration->camera.px, 536, 5 * result.calibration->parameters[0].deviation);
}

TEST(Calibrated, AsksViSPOnlyWhenTold) {
  CalibrationJob job = job_of(test::straight(), CameraModel::None, 8);
  job.cross_check = CrossCheck::None;
  EXPECT_FALSE(calibrated(job).visp.has_value());
}

TEST(Calibrated, RefusesTooFewViewsBeforeItSolves) {
  const CalibrationResult result = calibrated(job_of(test::straight(), CameraModel::None, 2));
  EXPECT_FALSE(result.calibration.has_value());
  ASSERT_TRUE(is_refused(result.objections));
  EXPECT_THAT(result.objections[0].what, HasSubstr("seen in 2 pictures"));
}

TEST(Calibrated, TurnsWhatCannotBeSolvedIntoARefusal) {
  CalibrationJob job = job_of(test::straight(), CameraModel::None, 5);
  job.views[1].points[0].in_image.u = -20;
  const CalibrationResult result = calibrated(job);
  EXPECT_FALSE(result.calibration.has_value());
  ASSERT_TRUE(is_refused(result.objections));
  EXPECT_EQ(result.objections[0].what, "no camera is found");
  EXPECT_THAT(result.objections[0].remedy, HasSubstr("view 2: a point at (-20.0"));
}

// A straight lens looked for where there is a fisheye.
TEST(Calibrated, RefusesALensThatDoesNotFit) {
  CalibrationJob job = job_of(test::fisheye(), CameraModel::None, 10);
  job.cross_check = CrossCheck::None;
  const CalibrationResult result = calibrated(job);
  EXPECT_TRUE(is_refused(result.objections));
}

// Points in another order: no board of this shape was seen.
TEST(Calibrated, RefusesAnotherBoard) {
  CalibrationJob job = job_of(test::straight(), CameraModel::None, 10);
  job.cross_check = CrossCheck::None;
  for (BoardView& view : job.views)
    for (BoardPoint& point : view.points) point.id = (point.id * 4) % 35;
  EXPECT_TRUE(is_refused(calibrated(job).objections));
}

TEST(Calibrated, ChecksTheJob) {
  CalibrationJob job = job_of(test::straight(), CameraModel::None, 5);
  job.board.rows = 0;
  EXPECT_THROW(calibrated(job), std::invalid_argument);
  job = job_of(test::straight(), CameraModel::None, 5);
  job.size = {0, 0};
  EXPECT_THROW(calibrated(job), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
