#include "kestrel/lab/law_sight.hpp"

#include <algorithm>

#include "kestrel/geometry/point_homography.hpp"
#include "kestrel/geometry/point_pose.hpp"

#include "law_needs.hpp"

namespace kestrel {
namespace {

/// Nothing stands between the law and the true points.
bool is_exact(const Conditions& c) {
  return c.noise_px == 0 && c.focal_factor == 1 && c.principal_u_px == 0 && c.principal_v_px == 0;
}

std::vector<ImagePoint> image_points(const std::vector<Feature>& features) {
  std::vector<ImagePoint> points;
  points.reserve(features.size());
  for (const Feature& feature : features) points.push_back(feature.at);
  return points;
}

}  // namespace

LawSight::LawSight(const CameraSetup& setup)
    : setup_(setup),
      noise_(setup.conditions.seed, setup.conditions.noise_px),
      desired_(seen_points(setup.scenario.goal, setup.scenario.points_m)) {
  const Conditions& c = setup_.conditions;
  const LabCamera& camera = setup_.camera;
  reached_.resize(Eigen::Index(2 * desired_.size()));
  for (std::size_t i = 0; i < desired_.size(); ++i) {
    ImagePoint& at = desired_[i].at;
    auto seen = reached_.segment<2>(Eigen::Index(2 * i));
    if (c.desired == Conditions::Desired::Taught) {
      seen << at.x, at.y;
      at = believed(at);
    } else {
      seen << c.focal_factor * at.x + c.principal_u_px / camera.focal_px,
          c.focal_factor * at.y + c.principal_v_px / camera.focal_px;
    }
    desired_[i].depth_m *= c.depth_factor;
  }
  goal_ = setup.scenario.goal;
  if (c.desired == Conditions::Desired::Taught) goal_ = pose_from(desired_, *goal_);
  if (goal_) goal_ = scaled(*goal_);
  LawInput image;
  image.measured = desired_;
  image.desired = desired_;
  images_.assign(std::size_t(c.delay_frames) + 1, image);
}

ImagePoint LawSight::believed(const ImagePoint& point) const {
  const Conditions& c = setup_.conditions;
  const double focal_px = setup_.camera.focal_px;
  return {(point.x - c.principal_u_px / focal_px) / c.focal_factor,
          (point.y - c.principal_v_px / focal_px) / c.focal_factor};
}

TargetPose LawSight::scaled(TargetPose pose) const {
  pose.translation *= setup_.conditions.depth_factor;
  return pose;
}

std::optional<TargetPose> LawSight::pose_from(const std::vector<Feature>& points,
                                              const TargetPose& true_pose) const {
  if (!needs_pose(setup_.law.law) || is_exact(setup_.conditions)) return true_pose;
  return point_pose(setup_.scenario.points_m, image_points(points));
}

void LawSight::add_geometry(LawInput& input, const TargetPose& true_pose) const {
  const Law law = setup_.law.law;
  if (needs_homography(law)) {
    input.camera_from_goal_homography =
        point_homography(image_points(input.desired), image_points(input.measured));
  }
  if (!needs_pose(law)) return;
  input.camera_from_target = pose_from(input.measured, true_pose);
  input.goal_from_target = goal_;
  input.goal_from_camera.reset();
  if (!goal_ || !input.camera_from_target) return;
  input.camera_from_target = scaled(*input.camera_from_target);
  const GoalFromCamera motion = *goal_ * input.camera_from_target->inverse();
  input.goal_from_camera = Displacement{motion.rotation, motion.translation};
}

void LawSight::look(const std::vector<Feature>& points, const TargetPose& camera_from_target,
                    const Vector6d& motion) {
  ++step_;
  LawInput& image = images_[std::size_t(step_) % images_.size()];
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Pixel noise = noise_.next();
    const double f = setup_.camera.focal_px;
    const ImagePoint& at = points[i].at;
    image.measured[i] = {believed({at.x + noise.u / f, at.y + noise.v / f}),
                         setup_.conditions.depth_factor * points[i].depth_m};
  }
  image.camera_motion.reset();
  if (step_ > 0) image.camera_motion = motion;
  add_geometry(image, camera_from_target);
  // The first image is used until the second one is old enough: between them nothing moved.
  LawInput& used =
      images_[std::size_t(std::max(0, step_ - setup_.conditions.delay_frames)) % images_.size()];
  if (step_ > 0 && step_ <= setup_.conditions.delay_frames) used.camera_motion.reset();
  used.time_s = step_ / setup_.conditions.rate_hz;
}

const LawInput& LawSight::told() const {
  const int used = std::max(0, step_ - setup_.conditions.delay_frames);
  return images_[std::size_t(used) % images_.size()];
}

}  // namespace kestrel
