#include "kestrel/io/sequence_file.hpp"

#include <cmath>

namespace kestrel {
namespace {

std::optional<std::filesystem::path> path_if(const Section& section, const std::string& key) {
  return section.has(key) ? std::optional(section.path(key)) : std::nullopt;
}

std::int64_t frame_number(const Section& root, const std::string& key, std::int64_t otherwise) {
  const std::int64_t number = root.integer(key, otherwise);
  if (number < 0) root.fail(key, "is negative; frames count from 0");
  return number;
}

SequenceOptions read_options(const Section& root) {
  SequenceOptions options;
  options.input = root.path("images").string();
  options.package = root.text("package", std::string());
  if (root.has("first_number")) options.first_number = frame_number(root, "first_number", 0);
  options.first_frame = frame_number(root, "first_frame", 0);
  if (root.has("last_frame")) {
    options.last_frame = frame_number(root, "last_frame", 0);
    if (*options.last_frame < options.first_frame) {
      root.fail("last_frame", "comes before first_frame; raise it");
    }
  }
  if (root.has("rate_hz")) {
    options.rate_hz = root.number("rate_hz");
    if (!(*options.rate_hz > 0)) root.fail("rate_hz", "must be positive");
  }
  options.stamps = path_if(root, "stamps");
  return options;
}

}  // namespace

PixelBox read_pixel_box(const Section& section, const std::string& key) {
  const std::vector<double> box = section.numbers(key, 4);
  for (const double number : box) {
    if (number != std::floor(number)) section.fail(key, "give whole pixels: [x, y, width, height]");
  }
  if (box[0] < 0 || box[1] < 0 || box[2] < 1 || box[3] < 1) {
    section.fail(key, "is no rectangle in an image; give [x, y, width, height]");
  }
  return {box[0], box[1], box[2], box[3]};
}

SequenceDescription load_sequence(const std::filesystem::path& file) {
  const Section root = Section::load(file);
  SequenceDescription description;
  description.file = file;
  description.sequence = read_options(root);
  description.template_px = read_pixel_box(root, "template_px");
  description.camera = path_if(root, "camera");
  description.camera_name = root.text("camera_name", "Camera");
  description.truth = path_if(root, "truth");
  if (root.has("target_m")) {
    const std::vector<double> size = root.numbers("target_m", 2);
    if (!(size[0] > 0 && size[1] > 0)) root.fail("target_m", "must be positive: [width, height]");
    description.target_m = {size[0], size[1]};
  }
  description.what = root.text("what");
  description.origin = root.text("origin");
  description.licence = root.text("licence");
  root.done();
  return description;
}

}  // namespace kestrel
