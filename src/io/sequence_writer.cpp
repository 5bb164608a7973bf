#include "kestrel/io/sequence_writer.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/io/image_codec.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

/// The folder of the frames, made with all above it.
fs::path images_folder(const fs::path& folder, const std::string& name) {
  const fs::path description = folder / (name + ".yaml");
  if (fs::exists(description)) {
    throw std::runtime_error(description.string() +
                             ": is there already; remove it or name another folder");
  }
  std::error_code error;
  fs::create_directories(folder / name, error);
  if (error) {
    throw std::runtime_error((folder / name).string() + ": " + error.message() +
                             "; name a folder that can be written");
  }
  return folder / name;
}

bool is_written(const Camera& camera) {
  const Lens lens = camera.parameters().lens;
  return lens == Lens::Pinhole || lens == Lens::PlumbBob;
}

/// ROS's camera_info, as far as load_camera reads it.
std::string camera_text(const CameraParameters& p) {
  const auto& d = p.distortion;
  return fmt::format(
      "image_width: {}\nimage_height: {}\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [{}, 0, {}, 0, {}, {}, 0, 0, 1]\ndistortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [{}, {}, {}, {}, {}]\n",
      p.width, p.height, number(p.px), number(p.u0), number(p.py), number(p.v0), number(d[0]),
      number(d[1]), number(d[2]), number(d[3]), number(d[4]));
}

/// A text as YAML takes it whatever is in it.
std::string quoted(const std::string& text) {
  std::string in_quotes = "'";
  for (const char c : text) in_quotes += c == '\'' ? std::string("''") : std::string(1, c);
  return in_quotes + "'";
}

std::string description(const std::string& name, const SequenceHead& head) {
  const PixelBox& box = head.template_px;
  std::string text = fmt::format(
      "# Keys: sequences/README.md of Kestrel.\n"
      "images: {}/%06d.png\nfirst_number: 0\nrate_hz: {}\n"
      "template_px: [{}, {}, {}, {}]\ntruth: {}_truth.csv\n",
      name, number(head.rate_hz), box.u, box.v, box.width, box.height, name);
  if (is_written(head.camera)) text += fmt::format("camera: {}_camera.yaml\n", name);
  return text + fmt::format("what: {}\norigin: {}\nlicence: {}\n", quoted(head.what),
                            quoted(head.origin), quoted(head.licence));
}

std::string row(std::int64_t frame, const std::vector<double>& values) {
  std::string text = std::to_string(frame);
  for (const double value : values) text += ',' + number(value);
  return text;
}

void write_bytes(const fs::path& file, const std::vector<unsigned char>& bytes) {
  write_text(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

SequenceWriter::SequenceWriter(const fs::path& folder, const std::string& name,
                               const SequenceHead& head)
    : images_(images_folder(folder, name)),
      truth_(folder / (name + "_truth.csv")),
      homography_(folder / (name + "_homography.csv")),
      pose_(folder / (name + "_pose.csv")) {
  truth_.write("frame,x0,y0,x1,y1,x2,y2,x3,y3");
  homography_.write("frame,h00,h01,h02,h10,h11,h12,h20,h21,h22");
  pose_.write("frame,stamp_s,tx_m,ty_m,tz_m,rx_rad,ry_rad,rz_rad");
  if (is_written(head.camera)) {
    write_text(folder / (name + "_camera.yaml"), camera_text(head.camera.parameters()));
  }
  write_text(folder / (name + ".yaml"), description(name, head));
}

void SequenceWriter::write(const RecordedFrame& frame) {
  write_bytes(images_ / fmt::format("{:06d}.png", frame.index), encode_png(frame.gray));
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
