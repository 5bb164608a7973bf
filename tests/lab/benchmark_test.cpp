#include "kestrel/lab/benchmark.hpp"

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

double initial_error(const Scenario& scenario) {
  const std::vector<Feature> s = seen_points(scenario.start, scenario.points_m);
  const std::vector<Feature> goal = seen_points(scenario.goal, scenario.points_m);
  double squares = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    squares += std::pow(s[i].at.x - goal[i].at.x, 2) + std::pow(s[i].at.y - goal[i].at.y, 2);
  }
  return std::sqrt(squares);
}

TEST(Benchmark, StartsWithTheErrorsPublished) {
  const std::map<std::string, double> published{
      {"S0_tutorial", .469108}, {"S1_small", .216636},   {"S2_rz45", .288638},
      {"S3_rz90", .533333},     {"S4_rz135", .696834},   {"S5_rz160", .742789},
      {"S8_trans", .8},         {"S9_orbit40", .067461}, {"S10_rxry", .743911},
      {"S11_general", .769640}, {"S12_flip40", .058006}, {"S13_oblique", .053389}};
  int compared = 0;
  for (const Scenario& scenario : benchmark_scenarios()) {
    EXPECT_NO_THROW(scenario.check());
    const auto found = published.find(scenario.name);
    if (found == published.end()) continue;
    EXPECT_NEAR(initial_error(scenario), found->second, 1e-6) << scenario.name;
    ++compared;
  }
  EXPECT_EQ(compared, 12);
}

TEST(Benchmark, StartsWhereTheTablesSay) {
  const auto start = [](const char* name) {
    for (const Scenario& scenario : benchmark_scenarios()) {
      if (scenario.name == name) return scenario.start_in_goal();
    }
    throw std::invalid_argument(name);
  };
  // Six printed digits.
  EXPECT_TRUE(start("S0_tutorial")
                  .translation.isApprox(Eigen::Vector3d(-.242845, .098355, -.231760), 3e-6));
  EXPECT_TRUE(
      start("S12_flip40").translation.isApprox(Eigen::Vector3d(0, -.738606, .619764), 3e-6));
}

TEST(Benchmark, IdsAreUnique) {
  std::set<std::string> ids;
  const std::vector<CameraExperiment> all = benchmark_experiments(0);
  for (const CameraExperiment& experiment : all) {
    EXPECT_NO_THROW(experiment.setup.check());
    ids.insert(experiment.id());
  }
  EXPECT_EQ(ids.size(), all.size());
  EXPECT_EQ(all.size(), all_laws().size() * (14 + 2 * 14));
}

}  // namespace
}  // namespace kestrel
