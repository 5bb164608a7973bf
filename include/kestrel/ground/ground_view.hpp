#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "kestrel/ground/flight_scene.hpp"
#include "kestrel/io/match_log.hpp"
#include "kestrel/io/run_log.hpp"
#include "kestrel/loop/step.hpp"

namespace kestrel {

/// What a viewer is shown of one frame: its picture, and what was made of it.
struct GroundView {
  LogRow row;
  cv::Mat gray;                         // of its own, not shared with the source of the frames
  std::array<Pixel, 4> goal_corners{};  // where the goal wants the target's, px; NaN: no goal
  std::vector<Pixel> inliers;           // places of the keypoints that agree, px
  std::vector<Pixel> others;            // of those that matched and do not agree, px
  std::optional<TargetPose> seen;       // camera_from_target, the camera levelled; when seen
  std::optional<FlightScene> scene;     // with a task: it says what is where
  std::optional<std::array<Pixel, 2>> horizon;  // in the picture; with an attitude
  double chain_ms = 0;                          // from the frame to the command
  std::optional<double> latency_ms;             // from its capture to the command, where known
};

/// Puts the places of a frame's matches into its view.
void add_matches(LoggedMatches matches, GroundView& view);

/// Copies the picture; encodes nothing.
GroundView ground_view(const Frame& frame, const Step& step, const Template& model,
                       const Task& task, double chain_ms);

/// A pose measured with a tilted helicopter, as the levelled one would measure it from the same
/// place (what Task::goal is); as it is without an attitude.
TargetPose levelled(const TargetPose& camera_from_target, const std::optional<Attitude>& attitude,
                    const Mount& body_from_camera);

/// A pose as the log keeps it, camera_from_target.
TargetPose target_pose(const LoggedPose& logged);

/// A viewer's words of the frame, a JSON object: frame, stamp_s, size_px, status, miss, confidence,
/// corners, predicted, window, goal, inliers, others, keypoints, matches, agree (counts), state,
/// errors, error_norm, condition, twist, wanted, sent, chain_ms, latency_ms, distance_m, attitude
/// (roll, pitch, yaw), horizon, scene (target, goal, vehicle, sight; see FlightScene, a place being
/// forward, right, down, yaw). Pixels are pairs; null for what is not known.
std::string json(const GroundView& view);

}  // namespace kestrel
