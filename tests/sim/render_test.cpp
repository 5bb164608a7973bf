#include "kestrel/sim/render.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/sim/texture.hpp"

#include "support/random.hpp"
#include "support/supersampled_view.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;
using CameraPose = Transform<frame::World, frame::Camera>;

Camera small_camera() {
  CameraParameters p;
  p.width = 128;
  p.height = 96;
  p.px = 121;
  p.py = 119;
  p.u0 = 63.2;
  p.v0 = 47.9;
  return Camera(p);
}

/// The middle of the small camera's picture, for what is costly to know.
Camera middle_camera() {
  CameraParameters p = small_camera().parameters();
  p.width = 48;
  p.height = 32;
  p.u0 = 23.7;
  p.v0 = 15.6;
  return Camera(p);
}

Camera distorted_camera() {
  CameraParameters p;
  p.width = 72;
  p.height = 52;
  p.px = 71;
  p.py = 69;
  p.u0 = 36.2;
  p.v0 = 25.9;
  p.lens = Lens::PlumbBob;
  p.distortion = {-0.25, 0.08, 0.002, -0.001, 0};
  return Camera(p);
}

/// A camera that looks at the origin of the wall's plane from this far, turned by rotation_vector.
CameraPose looking(const Vector3d& theta_u, double distance_m, double x_m = 0, double y_m = 0) {
  const TargetPose camera_from_wall{rotation_from_vector(theta_u), {x_m, y_m, distance_m}};
  return world_from_wall() * camera_from_wall.inverse();
}

Scene on_wall(const cv::Mat& texture, double width_m, double height_m, double background) {
  Scene scene;
  scene.background_grey = background;
  scene.planes.push_back({texture, width_m, height_m, world_from_wall()});
  return scene;
}

/// Total light over black, in pixels of full white, and where its centre is.
struct Moments {
  double area_px = 0;
  Pixel centre;
};

Moments moments(const cv::Mat& picture) {
  Moments m;
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const double share = picture.at<std::uint8_t>(v, u) / 255.0;
      m.area_px += share;
      m.centre.u += share * u;
      m.centre.v += share * v;
    }
  }
  m.centre = {m.centre.u / m.area_px, m.centre.v / m.area_px};
  return m;
}

/// The same of the outline of a rectangle of the wall, projected by the camera model.
Moments projected_moments(const CameraPose& pose, const Camera& camera, double width_m,
                          double height_m) {
  constexpr int kSteps = 64;  // a side, so that a lens may bend it
  std::vector<Pixel> outline;
  const std::array<Vector3d, 4> corners{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const Vector3d a = corners[i] + (corners[(i + 1) % 4] - corners[i]) * k / kSteps;
      const Vector3d p = pose.inverse() * (world_from_wall() *
                                           Vector3d(a.x() * width_m / 2, a.y() * height_m / 2, 0));
      outline.push_back(camera.to_pixel({p.x() / p.z(), p.y() / p.z()}));
    }
  }
  Moments m;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Pixel& a = outline[i];
    const Pixel& b = outline[(i + 1) % outline.size()];
    const double cross = a.u * b.v - b.u * a.v;
    m.area_px += cross / 2;
    m.centre.u += cross * (a.u + b.u) / 6;
    m.centre.v += cross * (a.v + b.v) / 6;
  }
  m.centre = {m.centre.u / m.area_px, m.centre.v / m.area_px};
  return m;
}

// Rounding to 8 bits moves the centre of 100 edge pixels by 0.3/255 px or so; 0.05 px is what the
// tracker's best answer is off.
void expect_same(const Moments& seen, const Moments& expected) {
  EXPECT_NEAR(seen.centre.u, expected.centre.u, 0.02);
  EXPECT_NEAR(seen.centre.v, expected.centre.v, 0.02);
  EXPECT_NEAR(std::sqrt(seen.area_px / expected.area_px), 1, 0.002);
}

TEST(Render, PlaneAppearsWhereTheCameraModelPutsItsOutline) {
  test::Random random("outline");
  const Scene scene = on_wall(cv::Mat(30, 40, CV_8U, cv::Scalar(255)), 2.0, 1.5, 0);
  for (const Camera& camera : {small_camera(), distorted_camera()}) {
    for (int i = 0; i < 12; ++i) {
      const CameraPose pose = looking(random.rotation_vector(0.8), random.uniform(3.2, 8),
                                      random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
      expect_same(moments(render(scene, camera, pose)), projected_moments(pose, camera, 2.0, 1.5));
    }
  }
}

// A white patch inside a texture: from 8 times magnified to 10 times reduced, whatever level it is
// read from, it must lie where the geometry says.
TEST(Render, PictureOnThePlaneAppearsWhereTheCameraModelPutsItAtEveryScale) {
  test::Random random("patch");
  cv::Mat texture(361, 483, CV_8U, cv::Scalar(0));  // odd sizes: no level is exactly half another
  texture(cv::Rect(161, 120, 161, 121)) = 255;      // the middle third, to the texel
  for (double distance_m = 1.2; distance_m < 16; distance_m *= 1.23) {
    const CameraPose pose = looking(random.rotation_vector(0.5), distance_m,
                                    random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05));
    const Scene scene = on_wall(texture, 4.83 / 2, 3.61 / 2, 0);
    SCOPED_TRACE(distance_m);
    expect_same(moments(render(scene, small_camera(), pose)),
                projected_moments(pose, small_camera(), 1.61 / 2, 1.21 / 2));
  }
}

TEST(Render, FineCheckerboardIsItsMean) {
  cv::Mat board(512, 512, CV_8U);
  for (int i = 0; i < 512 * 512; ++i) board.data[i] = ((i / 512 + i) & 1) ? 250 : 10;
  const Scene scene = on_wall(board, 20, 20, 130);
  for (const double tilt : {0.0, 0.5, 1.1}) {
    const cv::Mat view =
        render(scene, small_camera(), looking({0, tilt, 0.2}, 10))(cv::Rect(20, 20, 88, 56));
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(view, mean, deviation);
    EXPECT_NEAR(mean[0], 130, 0.6);  // half a level of rounding
    EXPECT_LT(deviation[0], 6);      // of 120: less than 5 % passes as false texture
  }
}

TEST(Render, AgreesWithBruteForce) {
  Scene scene = on_wall(facade(450, 300, 30, 1), 15, 10, 200);
  scene.planes.push_back({poster(256, 192, 1), 2.0, 1.5, world_from_wall()});
  TexturedPlane floor{ground(200, 200, 1), 20, 20, {}};
  floor.world_from_target.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  floor.world_from_target.translation << -10, 0, 3;
  scene.planes.insert(scene.planes.begin(), floor);
  const std::array<CameraPose, 5> poses{looking({0, 0, 0}, 5), looking({0.1, 0.9, 0.2}, 4),
                                        looking({0, 0, 1}, 1.3), looking({-0.5, 0.1, 0}, 12),
                                        looking({1.2, 0, 0}, 3)};
  for (const CameraPose& pose : poses) {
    const cv::Mat view = render(scene, distorted_camera(), pose);
    const cv::Mat truth = test::supersampled_view(scene, distorted_camera(), pose, 6);
    cv::Mat difference;
    cv::subtract(view, truth, difference, cv::noArray(), CV_32F);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(difference, mean, deviation);
    // No light is lost: 0.096 at most, where 0.06 is one standard deviation of the mean over the
    // picture's 3744 pixels.
    EXPECT_NEAR(mean[0], 0, 0.15);
    EXPECT_LT(deviation[0], 4);  // of contrasts of 60: the response at half a cycle per pixel
  }
}

// Where a texel spans half a pixel or more the mean over an upright pixel is exact: rounding is
// left, of the texture's levels never and of the picture once, and what 32 rays a side miss of a
// texel.
TEST(Render, NearbyTextureIsItsMeanOverEachPixel) {
  const Scene scene = on_wall(poster(160, 120, 3), 2, 1.5, 128);
  for (const double texels : {0.2, 0.5, 0.9, 1.3, 1.8}) {  // per pixel
    const CameraPose pose = looking({0, 0, 0}, texels * 121 / 80, 0.003, -0.004);
    const cv::Mat view = render(scene, middle_camera(), pose);
    cv::Mat difference;
    cv::subtract(view, test::supersampled_view(scene, middle_camera(), pose, 10), difference,
                 cv::noArray(), CV_32F);
    EXPECT_LT(cv::norm(difference, cv::NORM_INF), 1.2) << texels;
    EXPECT_NEAR(cv::mean(difference)[0], 0, 0.1) << texels;
  }
}

// Turned on the axis the pixel's square lies askew to the texels and is taken for an upright one of
// the same spread; half the texture's contrast from texel to texel is 40.
TEST(Render, NearbyTextureIsNearItsMeanHoweverItIsTurned) {
  const Scene scene = on_wall(poster(160, 120, 3), 2, 1.5, 128);
  for (const double turn : {0.3, 0.8, 2.0}) {
    for (const double tilt : {0.0, 0.9}) {
      const CameraPose pose = world_from_wall() * TargetPose{rotation_from_vector({tilt, 0, 0}) *
                                                                 rotation_from_vector({0, 0, turn}),
                                                             {0, 0, 2}}
                                                      .inverse();
      const cv::Mat view = render(scene, middle_camera(), pose);
      cv::Mat difference;
      cv::subtract(view, test::supersampled_view(scene, middle_camera(), pose, 8), difference,
                   cv::noArray(), CV_32F);
      const cv::Mat within = difference(cv::Rect(2, 4, 44, 24));
      EXPECT_LT(cv::norm(within, cv::NORM_L2) / std::sqrt(within.total()), 2) << turn << tilt;
      EXPECT_NEAR(cv::mean(within)[0], 0, 0.2) << turn << tilt;
    }
  }
}

// A glass that takes no light sends every pixel through the blending of planes, run by run; without
// it tiles that one plane fills are read at once.
TEST(Render, FilledTilesAreWhatBlendingMakesOfThem) {
  Scene scene = on_wall(facade(450, 300, 30, 1), 15, 10, 200);
  TexturedPlane floor{ground(200, 200, 1), 20, 20, {}};
  floor.world_from_target.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  floor.world_from_target.translation << -10, 0, 3;
  scene.planes.insert(scene.planes.begin(), floor);
  Scene glazed = scene;
  glazed.planes.push_back({cv::Mat(8, 8, CV_8U, cv::Scalar(0)), 100, 100, world_from_wall()});
  glazed.planes.back().opacity = 1e-7;
  for (const CameraPose& pose :
       {looking({0, 0, 0}, 2), looking({0.5, 0.6, 0.3}, 4), looking({-0.5, 0.1, 0}, 12)}) {
    cv::Mat difference;
    cv::absdiff(render(scene, small_camera(), pose), render(glazed, small_camera(), pose),
                difference);
    // One footprint stands for 16 rows instead of for one: a few levels in few pixels.
    EXPECT_LE(cv::norm(difference, cv::NORM_INF), 6);
    EXPECT_LT(cv::mean(difference)[0], 0.1);
  }
}

// Motion of about a pixel is taken as a spread of each pixel: what it does to the picture must be
// what the mean of the views does, to a small part.
TEST(Render, MotionOfAPixelBlursAsTheMeanOfItsViews) {
  const Renderer renderer(on_wall(poster(160, 120, 3), 2, 1.5, 128), small_camera());
  for (const std::vector<int>& steps : {std::vector<int>{-1, 0, 1}, std::vector<int>{-1, 1}}) {
    for (const double texels : {0.6, 0.9, 1.2}) {  // per pixel
      const double distance_m = texels * 121 / 80;
      const double m_per_px = distance_m / 121;
      Band band;
      cv::Mat mean(96, 128, CV_32F, cv::Scalar(0));
      for (const int k : steps) {
        const CameraPose pose =
            looking({0, 0, 0.002 * k}, distance_m, 0.4 * k * m_per_px, -0.2 * k * m_per_px);
        band.during.push_back({0, pose});
        cv::accumulateWeighted(renderer.view(pose), mean, 1.0 / double(band.during.size()));
      }
      const cv::Rect within(64 - 30, 48 - 22, 60, 44);
      const auto rms_to = [&](const cv::Mat& picture) {
        cv::Mat difference;
        cv::subtract(picture, mean, difference, cv::noArray(), CV_32F);
        EXPECT_NEAR(cv::mean(difference(within))[0], 0, 0.2) << texels;
        return cv::norm(difference(within), cv::NORM_L2) / std::sqrt(double(within.area()));
      };
      const double blurred = rms_to(renderer.expose(Shot{band}));
      const double sharp = rms_to(renderer.view(looking({0, 0, 0}, distance_m)));
      EXPECT_LT(blurred, 1) << texels;  // 0.33 is rounding, the rest a box for steps
      EXPECT_GT(sharp, 2 * blurred) << texels;
    }
  }
}

TEST(Render, NothingIsSeenOfWhatIsBehindOrFacesAway) {
  const Scene scene = on_wall(cv::Mat(8, 8, CV_8U, cv::Scalar(0)), 2, 2, 77);
  const auto blank = [&](const CameraPose& pose) {
    const cv::Mat view = render(scene, small_camera(), pose);
    return cv::norm(view, cv::Mat(view.size(), CV_8U, cv::Scalar(77)), cv::NORM_INF) == 0;
  };
  EXPECT_FALSE(blank(looking({0, 0, 0}, 2)));
  EXPECT_TRUE(blank(looking({0, 0, 0}, -2)));        // the wall behind the camera's back
  EXPECT_TRUE(blank(looking({0, M_PI, 0}, 2)));      // from the other side
  EXPECT_TRUE(blank(looking({0, M_PI / 2, 0}, 2)));  // edge on
  EXPECT_TRUE(blank(looking({0, 0, 0}, 0)));         // in its plane
}

TEST(Render, LaterPlanesHideEarlierOnes) {
  Scene scene = on_wall(cv::Mat(8, 8, CV_8U, cv::Scalar(100)), 4, 4, 0);
  scene.planes.push_back({cv::Mat(8, 8, CV_8U, cv::Scalar(200)), 1, 1, world_from_wall()});
  const cv::Mat view = render(scene, small_camera(), looking({0, 0, 0}, 5));
  EXPECT_EQ(view.at<std::uint8_t>(48, 63), 200);
  EXPECT_EQ(view.at<std::uint8_t>(48, 83), 100);
  std::swap(scene.planes[0], scene.planes[1]);
  EXPECT_EQ(render(scene, small_camera(), looking({0, 0, 0}, 5)).at<std::uint8_t>(48, 63), 100);
}

TEST(Render, SameBytesAtAnyNumberOfThreads) {
  const Renderer renderer(on_wall(poster(256, 192, 1), 2, 1.5, 200), small_camera());
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat one = renderer.view(looking({0.2, 0.3, 0.1}, 3), {2, 5, 7});
  cv::setNumThreads(3);
  const cv::Mat three = renderer.view(looking({0.2, 0.3, 0.1}, 3), {2, 5, 7});
  cv::setNumThreads(before);
  EXPECT_EQ(cv::norm(one, three, cv::NORM_INF), 0);
}

TEST(Render, SameBytesWithAndWithoutAVX2) {
  Scene scene = on_wall(facade(450, 300, 30, 1), 15, 10, 200);
  scene.planes.push_back({poster(256, 192, 1), 2.0, 1.5, world_from_wall()});
  const Renderer renderer(scene, distorted_camera());
  RenderOptions options{2, 5, 7};
  for (const double distance_m : {1.0, 4.0, 20.0}) {
    const CameraPose pose = looking({0.2, 0.7, 0.1}, distance_m);
    options.simd = Simd::Auto;
    const cv::Mat fast = renderer.view(pose, options);
    options.simd = Simd::Baseline;
    EXPECT_EQ(cv::norm(fast, renderer.view(pose, options), cv::NORM_INF), 0) << distance_m;
  }
}

// A wall at 5 m, 121 px: sideways by 5 cm it moves 1.21 px everywhere, and on its own as well.
TEST(Render, KnowsHowFarWhatIsSeenMoves) {
  Scene scene = on_wall(cv::Mat(8, 8, CV_8U, cv::Scalar(100)), 20, 20, 0);
  scene.planes[0].motion.velocity_m_s = {0, 0.5, 0};
  const Renderer renderer(scene, small_camera());
  const CameraAt here{0, looking({0, 0, 0}, 5)};
  EXPECT_NEAR(renderer.motion_px(here, here), 0, 1e-3);
  EXPECT_NEAR(renderer.motion_px(here, {0, looking({0, 0, 0}, 5, 0.05)}), 1.21, 0.01);
  EXPECT_NEAR(renderer.motion_px(here, {0.1, here.world_from_camera}), 1.21, 0.01);
  EXPECT_EQ(renderer.motion_px({0, looking({0, M_PI, 0}, -5)}, here), 0);  // looks away
}

TEST(Render, NoiseIsGaussianAndNewInEveryFrame) {
  Scene scene;
  scene.background_grey = 128;
  const Renderer renderer(scene, small_camera());
  const double sigma = 6;
  const auto noise = [&](std::uint64_t seed, std::int64_t frame) {
    cv::Mat picture;
    renderer.view({}, {sigma, seed, frame}).convertTo(picture, CV_64F, 1 / sigma, -128 / sigma);
    return picture;
  };
  const cv::Mat a = noise(1, 0);
  const double n = double(a.total());
  const auto correlation = [n](const cv::Mat& x, const cv::Mat& y) { return x.dot(y) / n; };
  const double five_sigma = 5 / std::sqrt(n);
  EXPECT_NEAR(cv::mean(a)[0], 0, five_sigma);
  EXPECT_NEAR(correlation(a, a), 1, 5 * std::sqrt(2 / n) + 0.003);  // 1/12 of rounding
  const cv::Mat squares = a.mul(a);
  EXPECT_NEAR(correlation(squares, squares), 3, 5 * std::sqrt(96 / n) + 0.03);  // kurtosis
  EXPECT_NEAR(correlation(a, noise(1, 1)), 0, five_sigma);
  EXPECT_NEAR(correlation(a, noise(2, 0)), 0, five_sigma);
  EXPECT_EQ(cv::norm(a, noise(1, 0), cv::NORM_INF), 0);
  for (const auto& [du, dv] : {std::pair{1, 0}, {0, 1}, {1, 1}, {5, 0}}) {
    const cv::Mat left = a(cv::Rect(0, 0, a.cols - du, a.rows - dv)).clone();
    const cv::Mat right = a(cv::Rect(du, dv, a.cols - du, a.rows - dv)).clone();
    EXPECT_NEAR(correlation(left, right), 0, five_sigma);
  }
}

TEST(Render, BeyondTheLensThereIsOnlyBackground) {
  CameraParameters p = small_camera().parameters();
  p.lens = Lens::PlumbBob;
  p.distortion = {-1.5, 0, 0, 0, 0};  // folds over at r = 0.47, seen at 0.31: 38 px from the axis
  const Scene scene = on_wall(cv::Mat(8, 8, CV_8U, cv::Scalar(0)), 200, 200, 50);
  const cv::Mat view = render(scene, Camera(p), looking({0, 0, 0}, 2));
  EXPECT_EQ(view.at<std::uint8_t>(48, 63), 0);
  EXPECT_EQ(view.at<std::uint8_t>(2, 2), 50);
  EXPECT_EQ(view.at<std::uint8_t>(90, 120), 50);
}

TEST(Render, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Scene scene = on_wall(cv::Mat(8, 8, CV_8U, cv::Scalar(0)), 2, 2, 77);
  const Renderer renderer(scene, small_camera());
  EXPECT_THROW(renderer.view({Eigen::Matrix3d::Identity(), {nan, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(renderer.view({Eigen::Matrix3d::Constant(nan), {0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(renderer.view({}, {-1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(renderer.view({}, {nan, 0, 0}), std::invalid_argument);
  CameraParameters p = small_camera().parameters();
  p.width = 0;
  EXPECT_THROW(Renderer(scene, Camera(p)), std::invalid_argument);
  Scene broken = scene;
  broken.planes[0].texture.release();
  EXPECT_THROW(Renderer(broken, small_camera()), std::invalid_argument);
}

/// Two grey planes behind each other that fill the view.
Scene glass(double opacity) {
  Scene scene;
  for (const int grey : {200, 40}) {
    TexturedPlane plane{cv::Mat(8, 8, CV_8U, cv::Scalar(grey)), 100, 100, world_from_wall()};
    plane.world_from_target.translation.x() = grey == 40 ? -1 : 0;
    scene.planes.push_back(plane);
  }
  scene.planes[1].opacity = opacity;
  return scene;
}

Transform<frame::World, frame::Camera> from_five() {
  return {world_from_wall().rotation, {-5, 0, 0}};
}

Camera tiny_camera() {
  CameraParameters p;
  p.width = 33;
  p.height = 33;
  p.px = p.py = 30;
  p.u0 = p.v0 = 16;
  return Camera(p);
}

TEST(Render, LightShinesThroughWhatIsNotOpaque) {
  for (const double opacity : {0.25, 0.5, 1.0}) {
    const cv::Mat view = render(glass(opacity), tiny_camera(), from_five());
    const double expected = opacity * 40 + (1 - opacity) * 200;
    EXPECT_NEAR(view.at<std::uint8_t>(16, 16), expected, 0.51) << opacity;
  }
}

TEST(Render, PlanesComeAndGo) {
  Scene scene = glass(1);
  scene.planes[1].motion.until_s = 2;
  const Renderer renderer(scene, tiny_camera());
  EXPECT_EQ(renderer.expose(Shot{{0, {{1, from_five()}}}}).at<std::uint8_t>(16, 16), 40);
  EXPECT_EQ(renderer.expose(Shot{{0, {{3, from_five()}}}}).at<std::uint8_t>(16, 16), 200);
  // Half the exposure with it, half without.
  EXPECT_EQ(
      renderer.expose(Shot{{0, {{1, from_five()}, {3, from_five()}}}}).at<std::uint8_t>(16, 16),
      120);
  // The upper rows before it goes, the lower ones after.
  const cv::Mat rolled = renderer.expose(Shot{{0, {{1, from_five()}}}, {10, {{3, from_five()}}}});
  EXPECT_EQ(rolled.at<std::uint8_t>(9, 16), 40);
  EXPECT_EQ(rolled.at<std::uint8_t>(10, 16), 200);
}

TEST(Render, CornersAreDarkerAndGainIsOfAllLight) {
  RenderOptions options;
  options.vignetting = 0.4;
  options.gain = 0.5;
  const cv::Mat view = render(glass(1), tiny_camera(), from_five(), options);
  EXPECT_EQ(view.at<std::uint8_t>(16, 16), 20);
  EXPECT_EQ(view.at<std::uint8_t>(0, 0), 12);
  EXPECT_EQ(view.at<std::uint8_t>(16, 0), 16);  // half the squared distance
}

TEST(Render, RefusesAShotThatIsNone) {
  const Renderer renderer(glass(1), tiny_camera());
  EXPECT_THROW(renderer.expose(Shot{}), std::invalid_argument);
  EXPECT_THROW(renderer.expose(Shot{{0, {}}}), std::invalid_argument);
  EXPECT_THROW(renderer.expose(Shot{{5, {{0, from_five()}}}}), std::invalid_argument);
  RenderOptions options;
  options.vignetting = 2;
  EXPECT_THROW(render(glass(1), tiny_camera(), from_five(), options), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
