#include "kestrel/lab/helicopter_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/lab/helicopter_benchmark.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

PlannedHelicopter small() {
  PlannedHelicopter planned;
  planned.scenarios = {helicopter_h0()};
  planned.laws = {benchmark_helicopter_law("vp3_hh_des"), benchmark_helicopter_law("mejias")};
  planned.modifiers = {{"kz2", "kz2", {}, {"H0"}, {"mejias"}}};
  return planned;
}

std::string fault(const PlannedHelicopter& planned) {
  return test::message_of([&] { planned.check(); });
}

TEST(HelicopterPlan, ReadsTheLabelsOfLawsOnAHelicopter) {
  EXPECT_EQ(helicopter_law_labelled("vp3_hh_mean"), std::pair(HelicopterVariant::Vp3Hh, Law::Mean));
  EXPECT_EQ(helicopter_law_labelled("vp3_des"), std::pair(HelicopterVariant::Vp3, Law::Des));
  EXPECT_EQ(helicopter_law_labelled("mejias"),
            std::pair(HelicopterVariant::Mejias, Law::Decoupled));
}

TEST(HelicopterPlan, NamesWhatIsWrong) {
  EXPECT_NO_THROW(small().check());
  PlannedHelicopter planned = small();
  planned.modifiers[0].scenarios = {"H1"};
  EXPECT_THAT(fault(planned), HasSubstr("there is no scenario H1; name one of its scenarios"));
  planned = small();
  planned.modifiers[0].laws = {"vp4_des"};
  EXPECT_THAT(fault(planned), HasSubstr("there is no law vp4_des; name one of its laws"));
  planned = small();
  planned.modifiers[0].settings = {{"noise_px", -1}};
  EXPECT_THAT(fault(planned), HasSubstr("noise_px"));
  planned = small();
  planned.laws[0].settings = {{"limit_down_m_s", -1}};
  EXPECT_THAT(fault(planned), HasSubstr("down"));
  planned = small();
  planned.laws[0].options.heading_gain_per_s = -1;
  EXPECT_THAT(fault(planned), HasSubstr("heading_gain_per_s"));
  planned = small();
  planned.rules.still_s = 0;
  EXPECT_THAT(fault(planned), HasSubstr("still_s"));
  planned = small();
  planned.camera.focal_px = 0;
  EXPECT_THAT(fault(planned), HasSubstr("focal_px"));
}

TEST(HelicopterPlan, AFlightWithoutOptionsIsThatOfTheBenchmark) {
  const PlannedHelicopter planned = small();
  const PlannedModifier modifier{"d6_pred", "d6_pred", {}, {}, {}};
  const LabRun made = run(planned_flight(planned, planned.scenarios[0], planned.laws[0], modifier));
  const LabRun expected =
      run(helicopter_experiment(helicopter_h0(), HelicopterVariant::Vp3Hh, Law::Des, "d6_pred"));
  EXPECT_EQ(made.id, expected.id);
  EXPECT_EQ(made.metrics, expected.metrics);
}

TEST(HelicopterPlan, ALawsSettingsComeAfterThePlansAndBeforeTheModifiers) {
  PlannedHelicopter planned = small();
  planned.conditions.noise_px = 3;
  planned.laws[0].settings = {{"predicted", 1}, {"limit_down_m_s", 0.5}};
  const PlannedModifier modifier{"m", "", {{"limit_down_m_s", 0.25}}, {}, {}};
  const auto conditions = [&](std::size_t law, const PlannedModifier& by) {
    return planned_flight(planned, planned.scenarios[0], planned.laws[law], by).setup.conditions;
  };
  const PlannedModifier none;
  EXPECT_TRUE(conditions(0, none).predicted);
  EXPECT_EQ(conditions(0, none).limits->speed.down_m_s, 0.5);
  EXPECT_EQ(conditions(0, modifier).limits->speed.down_m_s, 0.25);
  EXPECT_EQ(conditions(0, modifier).noise_px, 3);
  EXPECT_FALSE(conditions(1, none).predicted);
  EXPECT_EQ(conditions(1, none).limits->speed.down_m_s, 1.0);
}

TEST(HelicopterPlan, ALawsOwnConditionsAreThoseOfWhatItSends) {
  for (const std::string& key : helicopter_law_setting_keys()) {
    EXPECT_NO_THROW(with_setting(HelicopterConditions{}, {key, 1})) << key;
  }
  EXPECT_THAT(helicopter_law_setting_keys(), testing::Contains("limited"));
  EXPECT_THAT(helicopter_law_setting_keys(), testing::Contains("acceleration_yaw_deg_s2"));
  EXPECT_THAT(helicopter_law_setting_keys(), testing::Not(testing::Contains("noise_px")));
}

}  // namespace
}  // namespace kestrel
