#include "track_job.hpp"

#include <string_view>

#include "kestrel/io/live_camera.hpp"
#include "kestrel/io/sequence_file.hpp"

#include "simulated_camera.hpp"

namespace kestrel::app {
namespace {

TrackJob described(const std::filesystem::path& file) {
  const SequenceDescription d = load_sequence(file);
  TrackJob job;
  job.sequence = d.sequence;
  job.roi = d.template_px;
  if (d.truth) job.truth = *d.truth;
  if (d.camera) job.camera = *d.camera;
  job.camera_name = d.camera_name;
  if (d.target_m) job.size_m = {(*d.target_m)[0], (*d.target_m)[1]};
  return job;
}

bool is_live(const std::string& input) {
  if (input == "dc1394") return true;
  for (const char* kind : {"camera:", "dc1394:", "http://", "rtsp://", "udp://", "sim:"}) {
    if (input.rfind(kind, 0) == 0) return true;
  }
  return false;
}

}  // namespace

TrackJob track_job(const TrackArguments& a) {
  const std::string extension = std::filesystem::path(a.input).extension().string();
  const bool description = extension == ".yaml" || extension == ".yml";
  TrackJob job = description ? described(a.input) : TrackJob{};
  if (!description) (is_live(a.input) ? job.live : job.sequence.input) = a.input;
  if (a.roi) job.roi = a.roi;
  if (a.first_frame > 0) job.sequence.first_frame = a.first_frame;
  if (a.last_frame) job.sequence.last_frame = a.last_frame;
  if (a.rate_hz) job.sequence.rate_hz = a.rate_hz;
  if (!a.truth.empty()) job.truth = a.truth;
  if (!a.camera.empty()) {
    job.camera = a.camera;
    job.camera_name = a.camera_name;
  }
  if (!a.size_m.empty()) job.size_m = a.size_m;
  return job;
}

std::unique_ptr<FrameSource> open_source(const TrackJob& job) {
  constexpr std::string_view kSimulated = "sim:";
  if (job.live.rfind(kSimulated, 0) == 0) {
    return open_simulated_camera(job.live.substr(kSimulated.size()));
  }
  return job.live.empty() ? open_sequence(job.sequence) : open_live(job.live);
}

std::filesystem::path default_folder(const std::string& input) {
  std::filesystem::path path = std::filesystem::path(input).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (path.filename().string().find('%') != std::string::npos) path = path.parent_path();
  const std::string stem = is_live(input) ? "" : path.stem().string();
  return std::filesystem::path("runs") / (stem.empty() ? "track" : "track-" + stem);
}

}  // namespace kestrel::app
