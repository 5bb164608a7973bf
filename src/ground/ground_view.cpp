#include "kestrel/ground/ground_view.hpp"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "kestrel/geometry/attitude.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::json;

/// A thousandth of a pixel is nothing on a screen, and the stream is read over a radio.
double rounded(double value) { return std::round(value * 1000) / 1000; }

Json pair(const Pixel& p) { return {rounded(p.u), rounded(p.v)}; }

template <class Pixels>
Json pairs(const Pixels& pixels) {
  Json all = Json::array();
  for (const Pixel& p : pixels) all.push_back(pair(p));
  return all;
}

template <class Pixels>
Json pairs_or_null(const std::optional<Pixels>& pixels) {
  return pixels ? pairs(*pixels) : Json();
}

Json rounded(const Eigen::Vector3d& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

Json rounded(const VehiclePlace& place) {
  Json all = rounded(place.position_m);
  all.push_back(rounded(place.yaw_rad));
  return all;
}

Json scene_json(const FlightScene& scene) {
  Json all;
  for (const Eigen::Vector3d& corner : scene.target_m) all["target"].push_back(rounded(corner));
  all["goal"] = rounded(scene.goal);
  all["vehicle"] = scene.vehicle ? rounded(*scene.vehicle) : Json();
  if (!scene.vehicle) return all;
  for (const Eigen::Vector3d& direction : scene.sight) all["sight"].push_back(rounded(direction));
  return all;
}

Json attitude_json(const std::optional<Attitude>& attitude) {
  if (!attitude) return {};
  return {rounded(attitude->roll), rounded(attitude->pitch), rounded(attitude->yaw)};
}

Json numbers(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

void add_track(Json& to, const LogRow& row) {
  to["status"] = name(row.status);
  to["stage"] = name(row.stage);
  to["miss"] = name(row.miss);
  to["age_s"] = row.age_s;
  to["confidence"] = row.confidence;
  to["keypoints"] = row.keypoints;
  to["matches"] = row.matches;
  to["agree"] = row.inliers;
  to["corners"] = pairs_or_null(row.corners);
  to["predicted"] = pairs_or_null(row.predicted);
  to["window"] = {row.window.u, row.window.v, row.window.width, row.window.height};
}

void add_decision(Json& to, const LogRow& row) {
  to["errors"] = row.servo ? Json(row.servo->error) : Json();
  to["error_norm"] = row.servo ? Json(row.servo->error_norm) : Json();
  to["condition"] = row.servo ? Json(row.servo->condition) : Json();
  to["twist"] = row.servo ? numbers(row.servo->twist.vector()) : Json();
  if (!row.decision) return;
  to["state"] = name(row.decision->state);
  to["wanted"] = numbers(row.decision->wanted.vector());
  to["sent"] = numbers(row.decision->sent.vector());
}

}  // namespace

TargetPose levelled(const TargetPose& camera_from_target, const std::optional<Attitude>& attitude,
                    const Mount& body_from_camera) {
  if (!attitude) return camera_from_target;
  const Eigen::Matrix3d R = level_camera_from_camera(body_from_camera.rotation, *attitude);
  return {R * camera_from_target.rotation, R * camera_from_target.translation};
}

GroundView ground_view(const Frame& frame, const Step& step, const Template& model,
                       const Task& task, double chain_ms) {
  GroundView view;
  view.row = log_row(frame, model, step);
  view.gray = frame.gray.clone();
  const std::vector<Feature> desired = desired_features(task);
  for (std::size_t i = 0; i < view.goal_corners.size(); ++i) {
    view.goal_corners[i] = task.camera.to_pixel(desired[i].at);
  }
  add_matches(logged_matches(step.track), view);
  if (step.pose) {
    view.seen = levelled(step.pose->camera_from_target, frame.attitude, task.body_from_camera);
  }
  view.scene = flight_scene(task, view.seen, frame.attitude);
  if (frame.attitude) view.horizon = horizon(task.camera, task.body_from_camera, *frame.attitude);
  view.chain_ms = chain_ms;
  return view;
}

void add_matches(LoggedMatches matches, GroundView& view) {
  view.inliers = std::move(matches.inliers);
  view.others = std::move(matches.others);
}

TargetPose target_pose(const LoggedPose& logged) {
  const double angle = logged.rotation_rad.norm();
  TargetPose pose;
  pose.translation = logged.translation_m;
  if (angle > 0) {
    pose.rotation = Eigen::AngleAxisd(angle, logged.rotation_rad / angle).toRotationMatrix();
  }
  return pose;
}

std::string json(const GroundView& view) {
  Json all;
  all["frame"] = view.row.frame;
  all["stamp_s"] = view.row.stamp_s;
  all["size_px"] = {view.gray.cols, view.gray.rows};
  add_track(all, view.row);
  all["goal"] = pairs(view.goal_corners);
  all["inliers"] = pairs(view.inliers);
  all["others"] = pairs(view.others);
  add_decision(all, view.row);
  all["chain_ms"] = rounded(view.chain_ms);
  all["latency_ms"] = view.latency_ms ? Json(rounded(*view.latency_ms)) : Json();
  all["attitude"] = attitude_json(view.row.attitude);
  all["horizon"] = pairs_or_null(view.horizon);
  all["scene"] = view.scene ? scene_json(*view.scene) : Json();
  all["distance_m"] = view.seen ? Json(view.seen->translation.norm()) : Json();
  return all.dump();
}

}  // namespace kestrel
