#include "kestrel/lab/helicopter_benchmark.hpp"

#include <limits>
#include <utility>

namespace kestrel {
namespace {

using Variant = HelicopterVariant;

std::vector<std::pair<Variant, Law>> benchmark_laws() {
  std::vector<std::pair<Variant, Law>> laws;
  for (const Variant variant : all_helicopter_variants()) {
    if (variant == Variant::Mejias) {
      laws.emplace_back(variant, Law::Decoupled);
      continue;
    }
    for (const Law law : {Law::Cur, Law::Des, Law::Mean}) laws.emplace_back(variant, law);
  }
  return laws;
}

}  // namespace

HelicopterLawOptions benchmark_helicopter_law(HelicopterVariant variant, Law law) {
  constexpr double kGain_per_s = 0.5;
  HelicopterLawOptions options;
  options.variant = variant;
  options.law.law = law;
  options.law.gain = LawGain::constant(kGain_per_s);
  options.law.max_condition = std::numeric_limits<double>::infinity();
  options.heading_gain_per_s = kGain_per_s;
  return options;
}

HelicopterExperiment helicopter_experiment(const HelicopterScenario& scenario, Variant variant,
                                           Law law, const std::string& modifier) {
  HelicopterExperiment experiment;
  experiment.scenario = scenario.name;
  experiment.law = helicopter_law_label(variant, law);
  experiment.modifier = modifier;
  experiment.setup.scenario = scenario;
  experiment.setup.law = benchmark_helicopter_law(variant, law);
  experiment.setup.conditions = modified(HelicopterConditions{}, modifier);
  return experiment;
}

std::vector<HelicopterExperiment> helicopter_benchmark() {
  std::vector<HelicopterExperiment> experiments;
  for (const char* modifier :
       {"", "l2", "kz2", "kz4", "n1", "pitch2", "d6", "d6_pred", "seed0.93", "seed0.93_pred"}) {
    for (const HelicopterScenario& scenario : helicopter_scenarios()) {
      for (const auto& [variant, law] : benchmark_laws()) {
        experiments.push_back(helicopter_experiment(scenario, variant, law, modifier));
      }
    }
  }
  return experiments;
}

}  // namespace kestrel
