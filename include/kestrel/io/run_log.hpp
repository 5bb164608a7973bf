#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/io/csv.hpp"
#include "kestrel/loop/step.hpp"

namespace kestrel {

/// The target's pose in the camera as the log keeps it.
struct LoggedPose {
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // theta*u (ViSP: vpThetaUVector)
  double reprojection_px = 0;
  bool has_rival = false;  // the planar ambiguity had a second answer
};

/// What the servo law answered, as the log keeps it.
struct LoggedServo {
  std::array<double, 8> error{};  // e = s - s* of four corners, normalised image plane
  double error_norm = 0;
  double condition = 0;
  CameraTwist twist;
};

/// What was decided, as the log keeps it.
struct LoggedDecision {
  CommandState state = CommandState::Hover;
  VelocityCommand wanted;  // before the limits
  VelocityCommand sent;
};

/// Covariance of each corner's place in the image, px^2: of u, of u with v, of v.
using CornerNoise = std::array<std::array<double, 3>, 4>;

/// Everything of one frame. No time of processing is in it: the same task and frames give the same
/// log, byte for byte.
struct LogRow {
  std::int64_t frame = 0;
  double stamp_s = 0;
  TrackStatus status = TrackStatus::Lost;
  TrackStage stage = TrackStage::None;
  Miss miss = Miss::None;
  double age_s = 0;        // since the target was found
  double confidence = 0;   // 0 to 1
  double alike_share = 0;  // of the template's visible blocks that the image shows
  PixelBox window;
  int keypoints = 0;
  int matches = 0;
  int inliers = 0;
  int trials = 0;
  std::optional<Homography> image_from_template;
  std::optional<std::array<Pixel, 4>> corners;    // of the template in the image, px
  std::optional<std::array<Pixel, 4>> predicted;  // corners where a target not seen is expected
  std::optional<CornerNoise> noise;               // of corners, or of predicted ones
  std::optional<Attitude> attitude;               // as the source gave it
  std::optional<LoggedPose> pose;
  std::optional<LoggedServo> servo;
  std::optional<LoggedDecision> decision;
  std::vector<double> extra;  // one for each extra column of the log; NaN: no value
};

/// The four corners' own blocks of their covariance.
CornerNoise corner_noise(const CornerCovariance& covariance);

/// What the tracker saw in a frame: the row of a run without servoing.
LogRow log_row(const Frame& frame, const Template& model, const Track& track);

/// All of a frame's way through the chain. The error is logged when it is of four corners.
LogRow log_row(const Frame& frame, const Template& model, const Step& step);

/// Names of the columns every log has, in order; units are in the names.
std::vector<std::string> log_columns();

/// The run log: CSV with a header, one row a frame, empty fields where there is no value. Each row
/// is handed to the operating system at once, so a killed program leaves whole rows.
class RunLog {
 public:
  /// Creates the file and writes the header. extra_columns: names of the caller's own columns (a-z,
  /// 0-9 and _, none twice; std::invalid_argument otherwise). Throws std::runtime_error with path,
  /// cause and remedy when the file cannot be written.
  explicit RunLog(const std::filesystem::path& path,
                  const std::vector<std::string>& extra_columns = {});

  /// Appends a row. Throws std::runtime_error when the disk does not take it, and
  /// std::invalid_argument when row.extra does not have one value for each extra column.
  void write(const LogRow& row);

 private:
  LineFile file_;
  std::size_t extra_columns_;
};

/// A run log read back.
struct LogFile {
  std::vector<std::string> extra_columns;
  std::vector<LogRow> rows;
  bool was_interrupted = false;  // the last line had no end and was dropped

  /// The values of an extra column, a row each; empty when the log has no such column.
  std::vector<double> extra(const std::string& column) const;
};

/// Reads a run log; what RunLog wrote comes back to the last bit. Columns it does not know become
/// extra columns. Throws std::runtime_error `file:line: column: what is wrong; remedy`.
LogFile read_log(const std::filesystem::path& path);

}  // namespace kestrel
