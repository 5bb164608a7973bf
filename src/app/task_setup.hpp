#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "kestrel/io/task_file.hpp"
#include "kestrel/vision/frame.hpp"
#include "kestrel/vision/template.hpp"

#include "arguments.hpp"
#include "chain.hpp"
#include "run_recorder.hpp"

namespace kestrel::app {

/// What a run leaves to its caller.
struct RunResult {
  std::filesystem::path folder;
  Summary summary;
  int exit_code = 0;
};

/// Options of the recorder of a run of this task.
RecorderOptions recorder_options(const RunArguments& run, const std::filesystem::path& task,
                                 double rate_hz, const std::vector<std::string>& extra_columns);

using Sections = std::vector<ReportSection> (*)(const LogFile&, const RunView&);

/// Writes summary and report of a finished run of the chain; more: sections that come last.
void finish_run(RunRecorder& recorder, const Template& model, const Task& task, const ChainEnd& end,
                const Summary& summary, const std::string& title, Sections sections,
                const std::vector<ReportSection>& more = {});

/// Prints the summary on stdout and where the run folder is.
void print_result(const RunResult& result);

/// Makes the command line's source the task's (see parse_source, whose refusal it throws).
/// Template, camera and size stay the task's, but for a described sequence's rectangle.
void override_source(Experiment& experiment, const std::string& text);

/// What became of a source that runs by itself, as a section of a summary; nothing for any other.
void add_source(Summary& summary, const FrameSource& source);

/// The frames of a task. Throws for a source that cannot be opened.
std::unique_ptr<FrameSource> open_source(const Experiment& experiment);

/// Frames per second of a task's source; 30 for a source that does not say.
double rate_hz(const Experiment& experiment);

/// The first frame of a source; throws std::runtime_error when there is none, and says which frames
/// could not be read.
Frame first_frame(FrameSource& source, const std::string& name);

/// The rectangle the user draws in the first frame. Throws std::runtime_error without a display or
/// when the user gives up.
PixelBox ask_rectangle(const Frame& first);

/// The tracker of a task, its template learned from the picture as it is, or from the rectangle in
/// the first frame, straightened where the camera has a lens.
Tracker learn_template(const Experiment& experiment, const Frame& first);

}  // namespace kestrel::app
