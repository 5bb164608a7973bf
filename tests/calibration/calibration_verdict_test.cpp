#include "kestrel/calibration/calibration_verdict.hpp"

#include <algorithm>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "board_views.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

/// A calibration that nothing speaks against, changed by each test in one thing.
class Verdict : public ::testing::Test {
 protected:
  Verdict() {
    calibration_.model = CameraModel::None;
    calibration_.camera = test::wide_angle().parameters();
    calibration_.parameters = {{"fx", 536, 1, "px"}, {"fy", 534, 1, "px"}};
    calibration_.rms_px = 0.3;
    for (int i = 0; i < 12; ++i) {
      SolvedView view;
      view.name = "picture " + std::to_string(i);
      view.rms_px = 0.3;
      view.camera_from_board.rotation = rotation_from_rpy(0.1 * (i - 6), 0.05 * (i % 3), 0);
      calibration_.views.push_back(view);
    }
    coverage_.share = 0.9;
  }
  std::vector<Objection> judged() const {
    return objections(calibration_, coverage_, hold_out_, options_);
  }
  void expect(Gravity gravity, const std::string& what, const std::string& remedy) const {
    const auto list = judged();
    ASSERT_EQ(list.size(), 1u) << what;
    EXPECT_EQ(list[0].gravity, gravity) << what;
    EXPECT_THAT(list[0].what, HasSubstr(what));
    EXPECT_THAT(list[0].remedy, HasSubstr(remedy));
    EXPECT_EQ(is_refused(list), gravity == Gravity::Refusal);
  }

  Calibration calibration_;
  Coverage coverage_;
  std::optional<HoldOut> hold_out_ = HoldOut{5, 0.33};
  VerdictOptions options_;
};

TEST_F(Verdict, HasNothingAgainstAGoodCalibration) { EXPECT_TRUE(judged().empty()); }

TEST_F(Verdict, CountsViews) {
  calibration_.views.erase(calibration_.views.begin() + 3, calibration_.views.begin() + 8);
  expect(Gravity::Doubt, "seen in 7 pictures", "10 to 20");
  calibration_.views.resize(3);
  calibration_.views[0].camera_from_board.rotation = rotation_from_rpy(0.5, 0, 0);
  expect(Gravity::Refusal, "seen in 3 pictures", "take 10 to 20");
  EXPECT_TRUE(is_refused(objections(std::vector<BoardView>(3))));
  EXPECT_TRUE(objections(std::vector<BoardView>(10)).empty());
}

TEST_F(Verdict, RefusesViewsWithoutTilt) {
  for (SolvedView& view : calibration_.views)  // turned in the image only
    view.camera_from_board.rotation = rotation_from_rpy(0.03, 0, view.rms_px);
  expect(Gravity::Refusal, "tilt differs by", "tilt it by 20 to 45 degrees");
}

TEST_F(Verdict, RefusesLargeResiduals) {
  hold_out_->rms_px = 2.5;
  for (SolvedView& view : calibration_.views) view.rms_px = 2.5;
  calibration_.rms_px = 2.5;
  expect(Gravity::Refusal, "reprojection error is 2.50 px", "columns and rows");
  calibration_.rms_px = 1.8;
  expect(Gravity::Doubt, "1.80 px", "flat");
}

TEST_F(Verdict, MeasuresResidualsByTheImagesWidth) {
  calibration_.camera = {1608, 1602, 960, 540, 1920, 1080};
  calibration_.rms_px = 2.2;  // of 1920 px: as 0.73 of 640
  hold_out_->rms_px = 2.2;
  EXPECT_TRUE(judged().empty());
}

TEST_F(Verdict, RefusesImplausibleFocalLengths) {
  calibration_.camera = {20000, 20000, 320, 240, 640, 480};
  expect(Gravity::Refusal, "focal length of 20000 px", "add tilted views");
  calibration_.camera = {100, 100, 320, 240, 640, 480};
  expect(Gravity::Refusal, "focal length of 100 px, 145 degrees", "columns and rows");
  calibration_.camera = {536, 400, 320, 240, 640, 480};
  expect(Gravity::Refusal, "pixels 1.34 times", "both axes");
}

TEST_F(Verdict, AllowsAFisheyeToBeWide) {
  calibration_.camera = {200, 200, 320, 240, 640, 480, Lens::KannalaBrandt, {0.01, 0, 0, 0, 0}};
  EXPECT_FALSE(is_refused(judged()));
  // Slope 1 - 0.9 t^2: folds at 1.05 rad, 141 px from the centre.
  calibration_.camera.distortion = {-0.3, 0, 0, 0, 0};
  expect(Gravity::Refusal, "folds over", "simpler lens model");
}

TEST_F(Verdict, RefusesACentreFarFromTheImages) {
  calibration_.camera = {536, 536, 500, 240, 640, 480};
  expect(Gravity::Refusal, "centre (500, 240)", "whole pictures");
}

TEST_F(Verdict, RefusesALensThatFoldsInsideTheImage) {
  // Slope 1 - 1.8 r^2: folds at r = 0.745, where pixels are 266 px from the centre; corners are at
  // 400 px.
  calibration_.camera = {536, 536, 320, 240, 640, 480, Lens::PlumbBob, {-0.6, 0, 0, 0, 0}};
  expect(Gravity::Refusal, "folds over", "simpler lens model");
}

TEST_F(Verdict, RefusesAFocalLengthThatIsNotKnown) {
  calibration_.parameters[1].deviation = 10;
  expect(Gravity::Doubt, "known to 1.9 % only", "strong tilt");
  calibration_.parameters[1].deviation = 80;
  expect(Gravity::Refusal, "known to 15.0 % only", "strong tilt");
}

TEST_F(Verdict, RefusesPoorCoverage) {
  coverage_.share = 0.5;
  expect(Gravity::Doubt, "seen in 50 % of the image", "corners");
  coverage_.share = 0.15;
  expect(Gravity::Refusal, "seen in 15 % of the image", "corners");
}

TEST_F(Verdict, NamesViewsThatStandOut) {
  calibration_.views[4].rms_px = 1.2;
  expect(Gravity::Doubt, "picture 4 has 1.20 px, 4.0 times", "leave it out");
}

TEST_F(Verdict, DoubtsAModelThatExplainsNewViewsBadly) {
  hold_out_->rms_px = 0.6;
  expect(Gravity::Doubt, "views left out have 0.60 px, the others 0.30 px", "simpler");
  hold_out_.reset();
  expect(Gravity::Doubt, "no hold-out error", "add views");
}

TEST_F(Verdict, PutsRefusalsFirst) {
  coverage_.share = 0.5;
  calibration_.views[4].rms_px = 1.2;
  calibration_.camera.u0 = 600;
  const auto list = judged();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].gravity, Gravity::Refusal);
  EXPECT_EQ(list[2].gravity, Gravity::Doubt);
}

TEST(VerdictOptions, NamesTheOptionOutOfRange) {
  const auto throws = [](auto change) {
    VerdictOptions options;
    change(options);
    EXPECT_THROW(options.check(), std::invalid_argument);
  };
  throws([](VerdictOptions& o) { o.fewest_views = 2; });
  throws([](VerdictOptions& o) { o.enough_views = 3; });
  throws([](VerdictOptions& o) { o.tilt_rad = -1; });
  throws([](VerdictOptions& o) { o.rms_doubted_px = 0; });
  throws([](VerdictOptions& o) { o.rms_refused_px = 0.1; });
  throws([](VerdictOptions& o) { o.coverage_refused = 2; });
  throws([](VerdictOptions& o) { o.coverage_doubted = -1; });
  throws([](VerdictOptions& o) { o.focal_doubt = 0; });
  throws([](VerdictOptions& o) { o.hold_out_ratio = 0.5; });
  throws([](VerdictOptions& o) { o.outlier_ratio = 0.5; });
}

}  // namespace
}  // namespace kestrel
