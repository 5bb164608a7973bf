#include "replay.hpp"

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "ground.hpp"
#include "ground_options.hpp"
#include "interrupt.hpp"
#include "recorded_run.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

/// The folder's own task, where there is one that can still be read.
std::optional<Experiment> experiment_of(const fs::path& folder, std::vector<std::string>& notes) {
  if (!fs::exists(folder / "configuration.yaml")) {
    notes.emplace_back("its task is not known: no goal is drawn");
    return std::nullopt;
  }
  try {
    return load_run(folder, {}).experiment;
  } catch (const std::runtime_error& error) {
    notes.push_back(std::string("its task cannot be read any more: ") + error.what());
    return std::nullopt;
  }
}

/// The run's own video, of which is certain that it is of this run.
std::optional<RunPictures> video_of(const fs::path& folder, int width_px,
                                    std::vector<std::string>& notes) {
  for (const char* name : {"run.mp4", "run.avi"}) {
    if (!fs::exists(folder / name)) continue;
    try {
      return RunPictures(folder / name, width_px);
    } catch (const std::runtime_error& error) {
      notes.push_back(std::string("its video cannot be read: ") + error.what());
    }
  }
  return std::nullopt;
}

/// Of the sequence that the task names.
std::optional<RunPictures> sequence_of(const std::optional<Experiment>& experiment,
                                       std::vector<std::string>& notes) {
  if (!experiment || !experiment->sequence) return std::nullopt;
  try {
    RunPictures pictures(*experiment->sequence);
    notes.emplace_back("pictures of the sequence in its task; with --source it ran another");
    return pictures;
  } catch (const std::runtime_error& error) {
    notes.push_back(std::string("its sequence cannot be read: ") + error.what());
    return std::nullopt;
  }
}

}  // namespace

void add_replay(CLI::App& app, const std::shared_ptr<ReplayArguments>& a) {
  auto* verb = app.add_subcommand("replay",
                                  "Show a recorded run, or two beside each other, in the ground "
                                  "station's page; Ctrl-C ends it");
  verb->add_option("RUNS", a->runs, "One run folder, or two to compare")
      ->required()
      ->expected(1, int(ReplayStation::kMaxRuns));
  a->ground.port = 0;
  add_ground_options(*verb, a->ground, "Port of the page (default 0: any free one)");
}

Recording load_recording(const fs::path& folder) {
  if (!is_run_folder(folder)) {
    throw std::runtime_error(folder.string() +
                             ": is no run folder; one has the file run.csv in it");
  }
  Recording made;
  ReplayRun& run = made.run;
  const fs::path plain = (folder / "").lexically_normal().parent_path();
  run.name = plain.filename().string();
  run.log = read_log(folder / "run.csv");
  if (run.log.rows.empty()) {
    throw std::runtime_error((folder / "run.csv").string() +
                             ": holds no frame; the run ended before its first one");
  }
  if (run.log.was_interrupted) {
    run.notes.emplace_back("the last line of run.csv has no end and was left out");
  }
  try {
    run.matches = read_matches(folder / "matches.csv");
  } catch (const FileError& error) {
    run.notes.push_back(std::string("no keypoints are drawn: ") + error.what());
  }
  run.chain_ms = chain_times_ms(folder / "timing.csv", run.log);
  const auto experiment = experiment_of(folder, run.notes);
  if (experiment) run.task = experiment->task;
  const int width_px = run.task ? picture_size_px(run)[0] : 0;
  auto pictures = video_of(folder, width_px, run.notes);
  if (!pictures) pictures = sequence_of(experiment, run.notes);
  if (pictures) made.pictures = std::move(*pictures);
  if (!pictures) run.notes.emplace_back("there are no pictures: numbers and outlines alone");
  return made;
}

int run(const ReplayArguments& a) {
  std::vector<Recording> recordings;
  for (const fs::path& folder : a.runs) recordings.push_back(load_recording(folder));
  for (const Recording& recording : recordings) {
    for (const std::string& note : recording.run.notes) {
      fmt::print(stderr, "{}: {}\n", recording.run.name, note);
    }
  }
  const GroundOptions options = ground_options(a.ground);
  ReplayStation station(options, ground_token(a.ground), std::move(recordings));
  announce(station.address(), options, a.ground);
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return kInterrupted;
}

}  // namespace kestrel::app
