#include "kestrel/calibration/calibration_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_up_result.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(CalibrationText, TellsEveryParameterWithItsDeviation) {
  const std::string text = calibration_text(test::made_up_result());
  for (const char* word : {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "standard deviation"})
    EXPECT_THAT(text, HasSubstr(word));
  EXPECT_THAT(text, HasSubstr("left <01>.jpg"));
  EXPECT_THAT(text, HasSubstr("ViSP"));
  EXPECT_THAT(text, HasSubstr("doubt: the board is seen in 8 pictures"));
  EXPECT_THAT(text, Not(HasSubstr("REFUSED")));
}

TEST(CalibrationText, TellsRefusalsWithTheirRemedy) {
  const std::string text = calibration_text(test::refused_result());
  EXPECT_THAT(text, HasSubstr("REFUSED: the board is seen in 2 pictures"));
  EXPECT_THAT(text, HasSubstr("do: take 10 to 20"));
}

TEST(ParameterTable, IsThatOfTheModel) {
  const ReportTable table = parameter_table(test::made_up_result());
  ASSERT_EQ(table.rows.size(), 8u);
  EXPECT_EQ(table.rows[0][0], "fx");
  EXPECT_EQ(table.rows[0][3], "px");
  EXPECT_EQ(table.rows[4][0], "k1");
  EXPECT_NEAR(std::stod(table.rows[0][1]), 536, 10);
  EXPECT_TRUE(parameter_table(test::refused_result()).rows.empty());
}

TEST(ViewTable, HasALineForEachView) {
  const ReportTable table = view_table(test::made_up_result());
  ASSERT_EQ(table.rows.size(), 8u);
  EXPECT_EQ(table.rows[0][0], "left <01>.jpg");
  EXPECT_EQ(table.rows[0][1], "35");
  const double tilt_deg = std::stod(table.rows[0][5]);
  EXPECT_GT(tilt_deg, 5);
  EXPECT_LT(tilt_deg, 60);
}

TEST(VispTable, HasTheModelOfViSP) {
  EXPECT_EQ(visp_table(test::made_up_result()).rows.size(), 6u);
  EXPECT_TRUE(visp_table(test::refused_result()).rows.empty());
}

TEST(CalibrationJson, HoldsEveryResidual) {
  const std::string json = calibration_json(test::made_up_result());
  EXPECT_THAT(json, HasSubstr("\"refused\": false"));
  EXPECT_THAT(json, HasSubstr("\"u_v_du_dv_px\""));
  EXPECT_THAT(json, HasSubstr("\"hold_out_rms_px\": 0."));
  EXPECT_THAT(json, HasSubstr("\"model\": \"radial-tangential\""));
  const std::string refused = calibration_json(test::refused_result());
  EXPECT_THAT(refused, HasSubstr("\"rms_px\": null"));
  EXPECT_THAT(refused, HasSubstr("\"weight\": \"refusal\""));
}

}  // namespace
}  // namespace kestrel
