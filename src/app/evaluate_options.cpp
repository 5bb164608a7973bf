#include <CLI/CLI.hpp>

#include "evaluate.hpp"
#include "evaluate_methods.hpp"

namespace kestrel::app {

void add_evaluate_options(CLI::App& verb, const std::shared_ptr<EvaluateArguments>& a,
                          const std::vector<std::string>& more) {
  std::vector<std::string> methods = own_methods();
  methods.insert(methods.end(), more.begin(), more.end());
  verb.add_option("SEQUENCES", a->inputs,
                  "sequences/NAME.yaml, a folder with sequence.txt and gt.csv, or a folder that "
                  "holds several of these")
      ->required();
  verb.add_option("--method", a->methods,
                  "How to track; again for more than one (default: all there are)")
      ->check(CLI::IsMember(methods))
      ->allow_extra_args(false);
  verb.add_option(
          "--set", a->settings,
          "KEY=VALUE,VALUE,...: a key of the section 'track' of a task file (tasks/README.md "
          "says its unit and default), e.g. match.ratio=0.7,0.8; several --set: every "
          "combination")
      ->check(CLI::Validator([](std::string& setting) { return setting_fault(setting); },
                             "KEY=VALUE,...", "setting"))
      ->allow_extra_args(false);
  verb.add_option("--output", a->output,
                  "Folder of the evaluation; one that is there is continued: finished runs of the "
                  "same program, settings and files are not run again (default runs/evaluate)");
  verb.add_option("--jobs", a->jobs, "Runs at a time (default: the number of cores)")
      ->check(CLI::Range(1, 1024));
  verb.add_flag_callback(
      "--fresh", [a] { a->earlier = Earlier::Redone; }, "Run everything again (default: continue)");
  verb.footer(
      "A frame is right within 10 px (mean distance of four corners); correct: within 5 px. "
      "Times are processor times of the tracker's thread, ms.\nThe output folder holds "
      "report.html, "
      "summary.csv, summary.json, times.csv and runs/. doc/evaluate.md explains every column.");
}

}  // namespace kestrel::app
