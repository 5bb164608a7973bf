#include "kestrel/servo/law.hpp"

#include "plan_parts.hpp"

namespace kestrel {

void fail_unknown(const Section& section, const std::string& key, const std::string& what,
                  const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest_word(word, known);
  std::string list;
  for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
  section.fail(key, "there is no " + what + " " + word +
                        (near.empty() ? "; write one of " + list : "; did you mean " + near + "?"));
}

Law law_of(const Section& section, const std::string& key, const std::string& word) {
  if (const auto law = law_named(word)) return *law;
  std::vector<std::string> known;
  for (const Law law : all_laws()) known.emplace_back(name(law));
  fail_unknown(section, key, "law", word, known);
}

LawOptions read_law_options(const Section& section, LawOptions options) {
  options.solver = section.choice<LawSolver>(
      "solver", {{"eigen", LawSolver::Eigen}, {"visp", LawSolver::Visp}}, options.solver);
  if (section.has("gain_per_s")) options.gain = LawGain::constant(section.number("gain_per_s"));
  read_numbers(section, gain_keys(), options.gain);
  read_numbers(section, law_keys(), options);
  or_fail(section, "", [&] { options.check(); });
  return options;
}

LabCamera read_camera(const Section& section) {
  LabCamera camera;
  camera.focal_px = section.number("focal_px", camera.focal_px);
  if (section.has("principal_px")) {
    const std::vector<double> principal = section.numbers("principal_px", 2);
    camera.principal_u_px = principal[0];
    camera.principal_v_px = principal[1];
  }
  if (section.has("size_px")) {
    const std::vector<double> size = section.numbers("size_px", 2);
    camera.width_px = int(size[0]);
    camera.height_px = int(size[1]);
    if (camera.width_px != size[0] || camera.height_px != size[1]) {
      section.fail("size_px", "are no whole numbers of pixels; write whole numbers");
    }
  }
  or_fail(section, "", [&] { camera.check(); });
  return camera;
}

}  // namespace kestrel
