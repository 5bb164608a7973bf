#include "kestrel/calibration/calibration_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "made_up_result.hpp"
#include "support/markup_check.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(CalibrationReport, ShowsCoverageResidualsViewsAndPictures) {
  const cv::Mat picture(480, 640, CV_8UC1, cv::Scalar(90));
  const Report report = calibration_report(test::made_up_result(), picture, 3);
  ASSERT_EQ(report.pictures.size(), 2u);
  EXPECT_THAT(report.pictures[0].caption, HasSubstr("view 4, as taken"));
  EXPECT_FALSE(report.pictures[1].jpeg.empty());
  const std::string page = report_html(report);
  EXPECT_THAT(page, HasSubstr("Where the board was seen"));
  EXPECT_THAT(page, HasSubstr("Residuals over the image"));
  EXPECT_THAT(page, HasSubstr("Reprojection error of each view"));
  EXPECT_THAT(page, HasSubstr("left &lt;01&gt;.jpg"));
  EXPECT_THAT(page, Not(HasSubstr("left <01>")));
  EXPECT_THAT(page, Not(HasSubstr("http://www.google")));
}

TEST(CalibrationReport, SaysFirstThatItIsRefused) {
  const Report report = calibration_report(test::refused_result(), cv::Mat(), 0);
  EXPECT_EQ(report.title, "Camera calibration: refused");
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_THAT(report.warnings[0], HasSubstr("Refused: the board is seen in 2 pictures; take"));
  EXPECT_TRUE(report.pictures.empty());
  EXPECT_EQ(report.sections.size(), 1u);
}

}  // namespace
}  // namespace kestrel
