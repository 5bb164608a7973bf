#pragma once

#include <filesystem>
#include <string>

#include "kestrel/geometry/transform.hpp"
#include "kestrel/io/yaml_section.hpp"

namespace kestrel {

/// The pose that a section gives in one of four ways:
/// `translation_m: [x, y, z]` with `rpy_deg: [roll, pitch, yaw]`, R = Rz(yaw) Ry(pitch) Rx(roll);
/// `translation_m` with `rotation`, 9 numbers row by row or 3 rows of 3;
/// `translation_m` with `theta_u_deg: [x, y, z]`, the rotation's axis times its angle;
/// ViSP's pose (vpPoseVector's YAML): `rows: 6`, `cols: 1`, `data: [tx, ty, tz, tux, tuy, tuz]`.
/// The rotation's columns are the axes of From seen in To. A matrix within 1e-3 of a rotation is
/// replaced by the nearest one, one to rounding kept as it is; anything else throws FileError that
/// says how far off it is. So do two of these ways at once, angles that look like radians, and keys
/// that can be read in more than one way (euler_deg, rpy_rad, quaternion ...): each with its
/// remedy.
template <class To, class From>
Transform<To, From> read_pose(const Section& section);

/// How the camera is mounted (body_from_camera): read_pose; or `preset:`, a direction of
/// mount_preset, with `translation_m` or at the reference point; or `file:`, another file with one.
/// Throws FileError also for a camera more than 20 m from the helicopter's reference point.
Mount read_mount(const Section& section);

/// The same from a file of its own.
Mount load_mount(const std::filesystem::path& file);

/// A mount in plain words: "the camera looks forward; image right is the helicopter's right; 0.30 m
/// ahead of, 0.10 m below the reference point".
std::string describe(const Mount& body_from_camera);

}  // namespace kestrel
