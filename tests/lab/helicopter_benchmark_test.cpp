#include "kestrel/lab/helicopter_benchmark.hpp"

#include <set>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(HelicopterBenchmark, EveryRunIsItsOwnAndPossible) {
  std::set<std::string> ids;
  for (const HelicopterExperiment& experiment : helicopter_benchmark()) {
    EXPECT_TRUE(ids.insert(experiment.id()).second) << experiment.id();
    EXPECT_NO_THROW(experiment.setup.check()) << experiment.id();
    EXPECT_EQ(experiment.scenario, experiment.setup.scenario.name);
  }
  EXPECT_EQ(ids.size(), 2u * 16 * 10);
  for (const char* id : {"H0/vp4_des", "H1/vp3_hh_mean/kz2", "H0/mejias/seed0.93_pred"}) {
    EXPECT_EQ(ids.count(id), 1u) << id;
  }
}

TEST(HelicopterBenchmark, LawsGoByTheBenchmarksGain) {
  const HelicopterLawOptions options = benchmark_helicopter_law(HelicopterVariant::Vp4, Law::Cur);
  EXPECT_EQ(options.variant, HelicopterVariant::Vp4);
  EXPECT_EQ(options.law.law, Law::Cur);
  EXPECT_EQ(options.law.gain.at(0.1), 0.5);
  EXPECT_EQ(options.heading_gain_per_s, 0.5);
}

}  // namespace
}  // namespace kestrel
