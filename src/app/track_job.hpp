#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/io/sequence.hpp"

#include "arguments.hpp"

namespace kestrel::app {

/// What the verb `track` works on: the command line over the sequence's own description.
struct TrackJob {
  SequenceOptions sequence;
  std::string live;  // URL of a live source, instead of the sequence
  std::optional<PixelBox> roi;
  std::filesystem::path truth;
  std::filesystem::path camera;
  std::string camera_name = "Camera";
  std::vector<double> size_m;  // width and height of the target; empty: unknown
};

/// Reads the description when the input is one. Throws as load_sequence.
TrackJob track_job(const TrackArguments& arguments);

/// The frames of a job. Throws for a source that cannot be opened.
std::unique_ptr<FrameSource> open_source(const TrackJob& job);

/// Where a run of this input goes by default: runs/track-NAME.
std::filesystem::path default_folder(const std::string& input);

}  // namespace kestrel::app
