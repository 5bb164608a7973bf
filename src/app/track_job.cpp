#include "track_job.hpp"

#include "kestrel/io/sequence_file.hpp"
#include "kestrel/io/source_address.hpp"

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

/// The job of an input that begins with a scheme.
TrackJob addressed(const std::string& text) {
  const SourceAddress source = parse_source(text);
  if (source.kind == SourceKind::Sequence) return described(source.place);
  TrackJob job;
  if (is_live(source.kind)) {
    job.live = text;
  } else {
    job.sequence.input = source.place;
  }
  return job;
}

/// The job of an input; one without a scheme is a description, or images or a video.
TrackJob job_of(const std::string& input) {
  const bool is_address = is_source_address(input) && input != "simulation";
  if (is_address) return addressed(input);
  const std::string extension = std::filesystem::path(input).extension().string();
  if (extension == ".yaml" || extension == ".yml") return described(input);
  TrackJob job;
  job.sequence.input = input;
  return job;
}

}  // namespace

TrackJob track_job(const TrackArguments& a) {
  TrackJob job = job_of(a.input);
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
  return job.live.empty() ? open_sequence(job.sequence) : open_camera(job.live);
}

std::filesystem::path default_folder(const std::string& input) {
  const bool is_address = is_source_address(input);
  const SourceAddress source = is_address ? parse_source(input) : SourceAddress{};
  if (is_address && is_live(source.kind)) return std::filesystem::path("runs") / "track";
  auto path = std::filesystem::path(is_address ? source.place : input).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (path.filename().string().find('%') != std::string::npos) path = path.parent_path();
  const std::string stem = path.stem().string();
  return std::filesystem::path("runs") / (stem.empty() ? "track" : "track-" + stem);
}

}  // namespace kestrel::app
