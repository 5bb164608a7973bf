// Our camera beside ViSP's vpImageSimulator: the same plane, pose, camera and picture.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>
#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpImage.h>
#include <visp3/robot/vpImageSimulator.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "kestrel/sim/render.hpp"
#include "kestrel/sim/texture.hpp"

#include "support/supersampled_view.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

Camera camera(int width, int height, double focal_px) {
  CameraParameters p;
  p.px = p.py = focal_px;
  p.u0 = (width - 1) / 2.0;
  p.v0 = (height - 1) / 2.0;
  p.width = width;
  p.height = height;
  return Camera(p);
}

/// One plane at the origin of the world, whose axes are those of its Target frame.
Scene one_plane(const cv::Mat& texture, double width_m) {
  Scene scene;
  scene.background_grey = 255;
  scene.planes.push_back({texture, width_m, width_m * texture.rows / texture.cols, {}});
  return scene;
}

/// Seen from this distance, the plane turned about x of the camera and then about its own normal.
TargetPose turned(double distance_m, double tilt, double roll) {
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()))
                                .toRotationMatrix();
  return {R, {0.02, -0.01, distance_m}};
}

/// A point of the plane's texture, in texels from the outer edge, where it is on the plane, m.
vpColVector texel(const TexturedPlane& plane, double s, double t) {
  vpColVector X(3, 0.0);
  X[0] = (s / plane.texture.cols - 0.5) * plane.width_m;
  X[1] = (t / plane.texture.rows - 0.5) * plane.height_m;
  return X;
}

/// ViSP's view. It spans the picture between the centres of its corner texels, where ours spans it
/// between their outer edges: its rectangle is half a texel smaller on each side, so that each
/// texel is in the same place.
cv::Mat visp_view(const TexturedPlane& plane, const Camera& camera, const TargetPose& pose) {
  const int columns = plane.texture.cols;
  const int rows = plane.texture.rows;
  vpImage<unsigned char> picture(static_cast<unsigned>(rows), static_cast<unsigned>(columns));
  for (int v = 0; v < rows; ++v) {
    std::copy_n(plane.texture.ptr(v), columns, picture[static_cast<unsigned>(v)]);
  }
  vpColVector corners[4] = {texel(plane, 0.5, 0.5), texel(plane, columns - 0.5, 0.5),
                            texel(plane, columns - 0.5, rows - 0.5), texel(plane, 0.5, rows - 0.5)};
  vpHomogeneousMatrix cMo;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) cMo[i][j] = pose.rotation(i, j);
    cMo[i][3] = pose.translation[i];
  }
  vpImageSimulator simulator(vpImageSimulator::GRAY_SCALED);
  simulator.init(picture, corners);
  simulator.setInterpolationType(vpImageSimulator::BILINEAR_INTERPOLATION);
  simulator.setCameraPosition(cMo);
  const CameraParameters& p = camera.parameters();
  vpImage<unsigned char> seen(static_cast<unsigned>(p.height), static_cast<unsigned>(p.width), 255);
  simulator.getImage(seen, vpCameraParameters(p.px, p.py, p.u0, p.v0));
  return cv::Mat(p.height, p.width, CV_8U, seen.bitmap).clone();
}

/// The camera in the world, whose axes are those of the plane.
Transform<frame::World, frame::Camera> in_world(const TargetPose& pose) {
  return Transform<frame::World, frame::Target>{} * pose.inverse();
}

/// The pixels whose place on the plane lies this many texels or more within its edges.
cv::Mat interior(const TexturedPlane& plane, const Camera& camera, const TargetPose& pose,
                 double texels) {
  const auto target_from_camera = pose.inverse();
  const Eigen::Vector3d& eye = target_from_camera.translation;
  cv::Mat mask(camera.parameters().height, camera.parameters().width, CV_8U, cv::Scalar(0));
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const ImagePoint p = camera.to_image_point({double(u), double(v)});
      const Eigen::Vector3d ray = target_from_camera.rotation * Eigen::Vector3d(p.x, p.y, 1);
      const Eigen::Vector3d at = eye - eye.z() / ray.z() * ray;
      const double edge_m = texels * plane.width_m / plane.texture.cols;
      const bool inside = std::abs(at.x()) < plane.width_m / 2 - edge_m &&
                          std::abs(at.y()) < plane.height_m / 2 - edge_m;
      if (inside) mask.at<std::uint8_t>(v, u) = 255;
    }
  }
  return mask;
}

/// Waves of at least 20 texels, contrast 80.
cv::Mat waves(int width_px, int height_px) {
  cv::Mat texture(height_px, width_px, CV_8U);
  for (int t = 0; t < height_px; ++t) {
    for (int s = 0; s < width_px; ++s) {
      const double grey = 128 + 40 * std::sin(2 * M_PI * (s + 0.3 * t) / 24) +
                          40 * std::sin(2 * M_PI * (t - 0.2 * s) / 22);
      texture.at<std::uint8_t>(t, s) = std::uint8_t(std::lround(grey));
    }
  }
  return texture;
}

double rms(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask) {
  cv::Mat difference;
  cv::subtract(a, b, difference, cv::noArray(), CV_32F);
  return cv::norm(difference, cv::NORM_L2, mask) / std::sqrt(double(cv::countNonZero(mask)));
}

// Two pixels a texel and nearly frontal, there is nothing to smooth and the two must agree. A texel
// wave of period P and amplitude A bends by A (2 pi / P)^2 < 3.3 a texel for each of the two, so a
// mean over half a texel differs from the point in its middle by less than 3.3 / 2 / 12 * (1/2)^2 =
// 0.03; each picture is rounded, ViSP downwards: 1.5 levels. A level more for its single precision.
TEST(RenderBesideViSP, AgreesInNearlyFrontalViews) {
  const Scene scene = one_plane(waves(160, 120), 2);
  const Camera seen_by = camera(400, 300, 400);
  for (const auto& [tilt_deg, roll_deg] :
       {std::pair(0, 0), std::pair(10, 0), std::pair(0, 25), std::pair(-12, 40)}) {
    const TargetPose pose = turned(2.5, tilt_deg * kDegree, roll_deg * kDegree);
    const cv::Mat mask = interior(scene.planes[0], seen_by, pose, 2);
    ASSERT_GT(cv::countNonZero(mask), 30000);
    const cv::Mat ours = render(scene, seen_by, in_world(pose));
    const cv::Mat theirs = visp_view(scene.planes[0], seen_by, pose);
    // ViSP fills two triangles and leaves holes where they meet, of its background's 255; the waves
    // do not go beyond 208.
    cv::Mat filled;
    cv::bitwise_and(theirs != 255, mask, filled);
    const double holes = 1 - cv::countNonZero(filled) / double(cv::countNonZero(mask));
    cv::Mat difference;
    cv::absdiff(ours, theirs, difference);
    double most = 0;
    cv::minMaxLoc(difference, nullptr, &most, nullptr, nullptr, filled);
    const double spread = rms(ours, theirs, filled);
    std::printf(
        "tilt %d, roll %d deg: differ by %.0f levels at most, %.2f rms; holes in ViSP's: %.2f %%\n",
        tilt_deg, roll_deg, most, spread, holes * 100);
    EXPECT_LE(most, 3) << tilt_deg << ' ' << roll_deg;
    EXPECT_LT(spread, 1) << tilt_deg << ' ' << roll_deg;
    EXPECT_LT(holes, 0.005) << tilt_deg << ' ' << roll_deg;
  }
}

// Far or oblique, several texels fall into a pixel. ViSP looks at one point of them, ours takes
// their mean; the truth is 64 rays a pixel.
TEST(RenderBesideViSP, IsNearerToTheTruthWhereThePlaneIsFarOrOblique) {
  const Scene scene = one_plane(poster(640, 480, 3), 2);
  const Camera seen_by = camera(160, 120, 200);
  struct View {
    const char* what;
    TargetPose pose;
  };
  for (const View& view :
       {View{"far (10 m)", turned(10, 0, 0)}, View{"oblique (65 deg)", turned(3, 65 * kDegree, 0)},
        View{"both (6 m, 55 deg)", turned(6, 55 * kDegree, 0.4)}}) {
    const cv::Mat truth = test::supersampled_view(scene, seen_by, in_world(view.pose), 8);
    const cv::Mat mask = interior(scene.planes[0], seen_by, view.pose, 12);
    ASSERT_GT(cv::countNonZero(mask), 200) << view.what;
    const double ours = rms(render(scene, seen_by, in_world(view.pose)), truth, mask);
    const double theirs = rms(visp_view(scene.planes[0], seen_by, view.pose), truth, mask);
    std::printf("%s: against 64 rays a pixel, ours %.1f levels rms, vpImageSimulator %.1f\n",
                view.what, ours, theirs);
    EXPECT_LT(ours, theirs / 2) << view.what;
  }
}

}  // namespace
}  // namespace kestrel
