#include <cmath>

#include <fmt/format.h>

#include "kestrel/calibration/hand_eye.hpp"
#include "kestrel/io/mount_file.hpp"
#include "kestrel/io/mount_writer.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

/// Roll, pitch, yaw of R = Rz Ry Rx, degrees.
Eigen::Vector3d rpy_deg(const Eigen::Matrix3d& R) {
  return Eigen::Vector3d(std::atan2(R(2, 1), R(2, 2)),
                         std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
                         std::atan2(R(1, 0), R(0, 0))) /
         kDegree;
}

std::string of_three(const Eigen::Vector3d& v, int digits) {
  return fmt::format("{:.{}f}, {:.{}f}, {:.{}f}", v.x(), digits, v.y(), digits, v.z(), digits);
}

std::string translation_line(const HandEyeResult& r) {
  if (!r.translation_deviation_m)
    return "  translation     not measured: the stations have no position\n";
  return fmt::format("  translation     [{}] m, standard deviations {} m\n",
                     of_three(r.body_from_camera->translation, 3),
                     of_three(*r.translation_deviation_m, 3));
}

}  // namespace

std::string hand_eye_text(const HandEyeResult& r) {
  std::string text;
  if (r.body_from_camera) {
    text += fmt::format("  mount           {}\n", describe(*r.body_from_camera));
    text +=
        fmt::format("  rpy_deg         [{}]\n", of_three(rpy_deg(r.body_from_camera->rotation), 2));
    text +=
        fmt::format("  known to        {} deg about the camera's x, y, z (standard deviation)\n",
                    of_three(r.rotation_deviation_rad / kDegree, 2));
    text += translation_line(r);
    text += fmt::format("  residual        {:.2f} deg (rms of {} stations)",
                        r.residual_rad / kDegree, r.residuals_rad.size());
    text += r.residual_m ? fmt::format(", {:.3f} m\n", *r.residual_m) : "\n";
  }
  text += fmt::format("  attitudes       spread by {} deg (rms about three axes)\n",
                      of_three(r.spread_rad / kDegree, 1));
  for (const Objection& o : r.objections) {
    text += fmt::format("{}: {}\n  do: {}\n", o.gravity == Gravity::Refusal ? "REFUSED" : "doubt",
                        o.what, o.remedy);
  }
  return text;
}

std::string hand_eye_mount(const HandEyeResult& r, const Eigen::Vector3d& translation_m) {
  Mount mount = r.body_from_camera.value();
  std::vector<std::string> comment = {
      fmt::format("Measured from {} attitudes (kestrel calibrate hand-eye, ViSP's "
                  "vpHandEyeCalibration).",
                  r.residuals_rad.size()),
      fmt::format(
          "Rotation: standard deviations {} deg about the camera's x, y, z; residual {:.2f} "
          "deg.",
          of_three(r.rotation_deviation_rad / kDegree, 2), r.residual_rad / kDegree)};
  if (r.translation_deviation_m) {
    comment.push_back("Translation: standard deviations " +
                      of_three(*r.translation_deviation_m, 3) + " m.");
  } else {
    mount.translation = translation_m;
    comment.emplace_back("Translation: not measured here, as it was given.");
  }
  return mount_yaml(mount, comment);
}

}  // namespace kestrel
