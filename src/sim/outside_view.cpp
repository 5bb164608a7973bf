#include "kestrel/sim/outside_view.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

namespace kestrel {
namespace {

using Eigen::Vector3d;
using Eye = Transform<frame::World, frame::Camera>;

const cv::Scalar kBody(30, 30, 220), kRotor(40, 160, 255), kSight(200, 200, 60), kWay(220, 120, 30),
    kGoal(60, 180, 60);

Camera wide_camera(cv::Size size) {
  if (size.width < 64 || size.height < 48) {
    throw std::invalid_argument("size_px: must be at least 64x48");
  }
  CameraParameters p;
  p.width = size.width;
  p.height = size.height;
  p.px = p.py = 0.8 * size.width;
  p.u0 = (size.width - 1) / 2.0;
  p.v0 = (size.height - 1) / 2.0;
  return Camera(p);
}

/// An eye at `from` that looks at `at`, upright.
Eye looking(const Vector3d& from, const Vector3d& at) {
  const Vector3d ahead = (at - from).normalized();
  const Vector3d right = Vector3d::UnitZ().cross(ahead).normalized();
  Eye eye;
  eye.rotation << right, ahead.cross(right), ahead;
  eye.translation = from;
  return eye;
}

/// South-east of the way and above it, so far off that both ends are in view.
Eye bystander(const Vector3d& start, const Vector3d& goal) {
  if (!start.allFinite() || !goal.allFinite()) {
    throw std::invalid_argument("start_m and goal_m must be finite");
  }
  const Vector3d middle = (start + goal) / 2;
  const double far_m = 5 + 1.1 * (start - goal).norm();
  return looking(middle + far_m * Vector3d(-0.55, 0.75, -0.35), middle);
}

/// Draws lines of the world; those not in front of the eye are left out.
class Pen {
 public:
  Pen(cv::Mat& picture, const Camera& camera, const Eye& eye)
      : picture_(picture), camera_(camera), eye_from_world_(eye.inverse()) {}

  void line(const Vector3d& from, const Vector3d& to, const cv::Scalar& colour, int width) const {
    const Vector3d a = eye_from_world_ * from;
    const Vector3d b = eye_from_world_ * to;
    constexpr double kNearest_m = 0.1;
    if (a.z() < kNearest_m || b.z() < kNearest_m) return;
    cv::line(picture_, point(a), point(b), colour, width, cv::LINE_AA);
  }

 private:
  cv::Point point(const Vector3d& in_eye) const {
    const Pixel p = camera_.to_pixel({in_eye.x() / in_eye.z(), in_eye.y() / in_eye.z()});
    constexpr double kFar_px = 1e4;  // what is farther out would overflow the drawing
    return {int(std::clamp(p.u, -kFar_px, kFar_px)), int(std::clamp(p.v, -kFar_px, kFar_px))};
  }

  cv::Mat& picture_;
  const Camera& camera_;
  Transform<frame::Camera, frame::World> eye_from_world_;
};

void draw_helicopter(const Pen& pen, const Transform<frame::World, frame::Body>& body) {
  const auto at = [&](double x, double y, double z) { return body * Vector3d(x, y, z); };
  pen.line(at(0.5, 0, 0), at(-1.1, 0, 0), kBody, 3);
  pen.line(at(-1.1, 0, 0.15), at(-1.1, 0, -0.3), kBody, 2);
  pen.line(at(0, 0, 0), at(0, 0, -0.35), kBody, 2);
  for (const double side : {-0.25, 0.25}) {
    pen.line(at(0.3, side, 0.35), at(-0.4, side, 0.35), kBody, 2);
    pen.line(at(0, 0, 0), at(0, side, 0.35), kBody, 1);
  }
  constexpr int kSides = 32;
  for (int i = 0; i < kSides; ++i) {
    const auto rim = [&](int k) {
      const double angle = 2 * M_PI * k / kSides;
      return at(0.9 * std::cos(angle), 0.9 * std::sin(angle), -0.35);
    };
    pen.line(rim(i), rim(i + 1), kRotor, 1);
  }
}

/// The corners of what a 56 by 44 degree camera sees, 2 m ahead.
void draw_sight(const Pen& pen, const Eye& camera) {
  Vector3d before = camera * Vector3d(-1.06, -0.8, 2);
  for (const auto& [x, y] : {std::pair(1.06, -0.8), {1.06, 0.8}, {-1.06, 0.8}, {-1.06, -0.8}}) {
    const Vector3d corner = camera * Vector3d(x, y, 2);
    pen.line(camera.translation, corner, kSight, 1);
    pen.line(before, corner, kSight, 1);
    before = corner;
  }
}

}  // namespace

OutsideView::OutsideView(const Scene& scene, const Vector3d& start_m, const Vector3d& goal_m,
                         cv::Size size_px)
    : camera_(wide_camera(size_px)),
      renderer_(scene, camera_),
      world_from_eye_(bystander(start_m, goal_m)) {}

cv::Mat OutsideView::draw(const Transform<frame::World, frame::Body>& world_from_body,
                          const Mount& body_from_camera, const Vector3d& goal_m, double time_s) {
  path_m_.push_back(world_from_body.translation);
  cv::Mat picture;
  cv::cvtColor(renderer_.expose(Shot{{0, {{time_s, world_from_eye_}}}}), picture,
               cv::COLOR_GRAY2BGR);
  const Pen pen(picture, camera_, world_from_eye_);
  for (std::size_t i = 1; i < path_m_.size(); ++i) pen.line(path_m_[i - 1], path_m_[i], kWay, 2);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d arm = 0.4 * Vector3d::Unit(axis);
    pen.line(goal_m - arm, goal_m + arm, kGoal, 2);
  }
  draw_sight(pen, world_from_body * body_from_camera);
  draw_helicopter(pen, world_from_body);
  return picture;
}

}  // namespace kestrel
