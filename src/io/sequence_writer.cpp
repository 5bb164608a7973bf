#include "kestrel/io/sequence_writer.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/io/camera_writer.hpp"
#include "kestrel/io/gray_image.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

/// The folder of the frames, made with all above it.
fs::path images_folder(const fs::path& folder, const std::string& name) {
  require_new_sequence(folder, name);
  std::error_code error;
  fs::create_directories(folder / name, error);
  if (error) {
    throw std::runtime_error((folder / name).string() + ": " + error.message() +
                             "; name a folder that can be written");
  }
  return folder / name;
}

std::string description(const std::string& name, const SequenceHead& head) {
  const PixelBox& box = head.template_px;
  std::string text = fmt::format(
      "# Keys: sequences/README.md of Kestrel.\n"
      "images: {}/%06d.png\nfirst_number: 0\nrate_hz: {}\n"
      "template_px: [{}, {}, {}, {}]\ntruth: {}_truth.csv\ncamera: {}_camera.yaml\n",
      name, number(head.rate_hz), box.u, box.v, box.width, box.height, name, name);
  return text + fmt::format("what: {}\norigin: {}\nlicence: {}\n", yaml_quoted(head.what),
                            yaml_quoted(head.origin), yaml_quoted(head.licence));
}

std::string row(std::int64_t frame, const std::vector<double>& values) {
  std::string text = std::to_string(frame);
  for (const double value : values) text += ',' + number(value);
  return text;
}

}  // namespace

void require_new_sequence(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / (name + ".yaml");
  if (!fs::exists(file)) return;
  throw std::runtime_error(file.string() + ": is there already; remove it or name another folder");
}

SequenceWriter::SequenceWriter(const fs::path& folder, const std::string& name,
                               const SequenceHead& head)
    : images_(images_folder(folder, name)),
      truth_(folder / (name + "_truth.csv")),
      homography_(folder / (name + "_homography.csv")),
      pose_(folder / (name + "_pose.csv")) {
  truth_.write("frame,x0,y0,x1,y1,x2,y2,x3,y3");
  homography_.write("frame,h00,h01,h02,h10,h11,h12,h20,h21,h22");
  pose_.write("frame,stamp_s,tx_m,ty_m,tz_m,rx_rad,ry_rad,rz_rad");
  write_text(folder / (name + "_camera.yaml"), ros_yaml(head.camera, name));
  write_text(folder / (name + ".yaml"), description(name, head));
}

void SequenceWriter::write(const RecordedFrame& frame) {
  save_png(images_ / fmt::format("{:06d}.png", frame.index), frame.gray);
  const Eigen::Vector3d& t = frame.camera_from_target.translation;
  const Eigen::Vector3d r = rotation_vector(frame.camera_from_target.rotation);
  pose_.write(row(frame.index, {frame.stamp_s, t.x(), t.y(), t.z(), r.x(), r.y(), r.z()}));
  const Eigen::Matrix3d& H = frame.image_from_first.H;
  homography_.write(row(frame.index, {H(0, 0), H(0, 1), H(0, 2), H(1, 0), H(1, 1), H(1, 2), H(2, 0),
                                      H(2, 1), H(2, 2)}));
  if (!frame.is_labelled) return;
  std::vector<double> corners;
  for (const Pixel& p : frame.corners) corners.insert(corners.end(), {p.u, p.v});
  truth_.write(row(frame.index, corners));
}

}  // namespace kestrel
