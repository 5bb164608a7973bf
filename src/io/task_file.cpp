#include "kestrel/io/task_file.hpp"

#include <cmath>
#include <stdexcept>

#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/mount_file.hpp"
#include "kestrel/io/source_address.hpp"
#include "kestrel/io/task_options.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// A file or pattern that a source names, relative to the task file.
std::string beside(const Section& root, const std::string& place) {
  return (root.file().parent_path() / place).lexically_normal().string();
}

SourceAddress read_source(const Section& root) {
  SourceAddress source;
  try {
    source = parse_source(root.text("source"));
  } catch (const std::invalid_argument& error) {
    root.fail("source", error.what());
  }
  const bool is_description =
      begins_with(source.text, "rtp:") && !begins_with(source.text, "rtp://");
  if (is_description) source.text = "rtp:" + beside(root, source.text.substr(4));
  return source;
}

std::string read_ground_link(const Section& root) {
  std::string link = root.text("ground_link");
  if (!begins_with(link, "udp://")) {
    root.fail("ground_link", "is '" + link + "'; give udp://HOST:PORT");
  }
  return link;
}

std::string read_sink(const Section& root) {
  std::string sink = root.text("sink", std::string("none"));
  if (sink != "none" && !begins_with(sink, "udp://") && !begins_with(sink, "autopilot:udp://")) {
    root.fail("sink", "is '" + sink + "'; give autopilot:udp://HOST:PORT, udp://HOST:PORT or none");
  }
  return sink;
}

/// What a source of recorded frames opens; rate_hz and the range of frames may be set in the task.
std::optional<SequenceOptions> read_recording(const Section& root, const SourceAddress& source,
                                              const std::optional<SequenceDescription>& described) {
  SequenceOptions options;
  if (described) {
    options = described->sequence;
  } else if (source.kind == SourceKind::Images || source.kind == SourceKind::Video) {
    options.input = beside(root, source.place);
  } else {
    return std::nullopt;
  }
  if (root.has("rate_hz")) options.rate_hz = root.number("rate_hz");
  if (options.rate_hz && !(*options.rate_hz > 0)) root.fail("rate_hz", "must be positive");
  options.first_frame = root.integer("first_frame", options.first_frame);
  if (options.first_frame < 0) root.fail("first_frame", "is negative; frames count from 0");
  if (root.has("last_frame")) options.last_frame = root.integer("last_frame");
  if (options.last_frame && *options.last_frame < options.first_frame) {
    root.fail(root.has("last_frame") ? "last_frame" : "first_frame",
              "last_frame comes before first_frame; correct one of the two");
  }
  return options;
}

/// Intrinsics written in the task itself: for the simulation, or a camera known by heart.
Camera read_intrinsics(const Section& section) {
  const std::vector<double> K = section.numbers("intrinsics_px", 4);
  const std::vector<double> size = section.numbers("size_px", 2);
  for (const double side : size) {
    if (!(side >= 1 && side <= 1e5 && side == std::floor(side))) {
      section.fail("size_px", "is no image size; give [width, height] in whole pixels");
    }
  }
  CameraParameters p;
  p.px = K[0];
  p.py = K[1];
  p.u0 = K[2];
  p.v0 = K[3];
  p.width = int(size[0]);
  p.height = int(size[1]);
  try {
    return Camera(p);
  } catch (const std::invalid_argument& error) {
    section.fail("intrinsics_px", std::string(error.what()) + "; give [px, py, u0, v0]");
  }
}

struct FoundCamera {
  std::optional<fs::path> file;
  Camera camera;
};

FoundCamera read_camera(const Section& section,
                        const std::optional<SequenceDescription>& described) {
  if (section.has("intrinsics_px")) return {std::nullopt, read_intrinsics(section)};
  const bool own = section.has("file");
  if (!own && !(described && described->camera)) {
    section.fail("file", "is missing; name a camera file, or give intrinsics_px and size_px");
  }
  const fs::path file = own ? section.path("file") : *described->camera;
  const std::string name = section.text("name", own ? "Camera" : described->camera_name);
  std::optional<ImageSize> size;
  if (section.has("size_px")) {
    const std::vector<double> s = section.numbers("size_px", 2);
    size = ImageSize{int(s[0]), int(s[1])};
  }
  return {file, load_camera(file, name, size)};
}

Mount read_camera_mount(const Section& section) {
  if (!section.has("body_from_camera")) {
    section.fail(
        "body_from_camera",
        "is missing; say how the camera is mounted, e.g. {file: ../calib/mount_forward.yaml}");
  }
  return read_mount(section.child("body_from_camera"));
}

double read_size(const Section& target, const std::string& key, std::size_t side,
                 const std::optional<SequenceDescription>& described) {
  const bool known = described && described->target_m;
  if (!target.has(key) && known) return (*described->target_m)[side];
  const double size = target.number(key);
  if (!(size > 0)) target.fail(key, "must be positive; measure the template's rectangle");
  return size;
}

TargetPose read_goal(const Section& root) {
  const Section section = root.child("goal_camera_from_target");
  auto goal = read_pose<frame::Camera, frame::Target>(section);
  if (!(goal.translation.z() > 0)) {
    section.fail("translation_m", "puts the target behind the camera; its z must be positive");
  }
  return goal;
}

}  // namespace

Experiment read_experiment(const Section& root) {
  const SourceAddress source = read_source(root);
  std::optional<SequenceDescription> described;
  if (source.kind == SourceKind::Sequence) described = load_sequence(beside(root, source.place));
  const Section camera = root.child("camera");
  const FoundCamera found = read_camera(camera, described);
  const Mount mount = read_camera_mount(camera);
  const Section target = root.child("target");
  Task task{found.camera,
            mount,
            read_size(target, "width_m", 0, described),
            read_size(target, "height_m", 1, described),
            read_goal(root),
            read_track_options(root),
            read_pose_options(root),
            read_servo_options(root),
            read_command_limits(root),
            read_loss_options(root),
            read_timing_options(root)};
  if (found.camera.parameters().lens != Lens::Pinhole) task.track.lens = found.camera;
  Experiment e{root.file(), source.text, read_sink(root), task, {},
               {},          {},          found.file,      {},   read_live_options(root)};
  if (root.has("ground_link")) e.ground_link = read_ground_link(root);
  if (root.has("ground_link_key")) e.ground_link_key = root.path("ground_link_key");
  e.sequence = read_recording(root, source, described);
  if (target.has("image")) e.template_image = target.path("image");
  if (target.has("template_px")) {
    e.template_px = read_pixel_box(target, "template_px");
  } else if (described && !e.template_image) {
    e.template_px = described->template_px;
  }
  if (described) e.truth = described->truth;
  try {
    e.task.check();
  } catch (const std::invalid_argument& error) {
    root.fail("", std::string(error.what()) + "; see tasks/README.md");
  }
  return e;
}

}  // namespace kestrel
