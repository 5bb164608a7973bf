#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/io/live_options.hpp"
#include "kestrel/io/sequence_file.hpp"
#include "kestrel/io/yaml_section.hpp"
#include "kestrel/loop/task.hpp"

namespace kestrel {

/// One experiment as a task file in tasks/ describes it; tasks/README.md documents every key.
struct Experiment {
  std::filesystem::path file;
  /// Where the frames come from, as written (see parse_source); of rtp:FILE.sdp the file is made
  /// relative to the working directory.
  std::string source;
  std::string sink;  // where the commands go, as written: "autopilot:udp://host:port",
                     // "udp://host:port" or "none"
  Task task;
  /// What to open for a source sequence:, images: or video:.
  std::optional<SequenceOptions> sequence;
  /// The rectangle to learn in the first frame; with template_image, in that image (absent: all of
  /// it). Both absent: the app must ask for it.
  std::optional<PixelBox> template_px;
  std::optional<std::filesystem::path> template_image;
  std::optional<std::filesystem::path> camera_file;  // absent: intrinsics given in the task
  std::optional<std::filesystem::path> truth;        // of a described sequence
  LiveOptions live;                                  // how a live source is opened
  /// The operator's own link to a switch, "udp://host:port", and the file of its key; empty: none.
  std::string ground_link{};
  std::filesystem::path ground_link_key{};
};

/// The experiment of a task file's root section. A described sequence (source: sequence:FILE) gives
/// the template's rectangle, the camera and the target's size where the task does not. Does not
/// call root.done(): an app reads its own sections first. Throws FileError with the line for every
/// mistake.
Experiment read_experiment(const Section& root);

}  // namespace kestrel
