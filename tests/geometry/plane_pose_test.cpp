#include "kestrel/geometry/plane_pose.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "support/random.hpp"

namespace kestrel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;
const double kNan = std::numeric_limits<double>::quiet_NaN();
const PlaneSize kPoster{320, 240, 0.8, 0.6};
const Camera kCamera(CameraParameters{600, 590, 319.5, 239.5, 640, 480});

/// A view of the plane's front: its distance, how far it leans away from the line of sight, and
/// how far the line of sight is off the axis; leaning, rolled and off axis to any side.
TargetPose view(test::Random& random, double distance_m, double tilt, double off_axis) {
  const double side = random.uniform(-M_PI, M_PI);
  const Vector3d sight(std::sin(off_axis) * std::cos(side), std::sin(off_axis) * std::sin(side),
                       std::cos(off_axis));
  const double lean = random.uniform(-M_PI, M_PI);
  const Matrix3d towards =
      rotation_from_vector(off_axis * Vector3d(-std::sin(side), std::cos(side), 0));
  return {towards * rotation_from_vector(tilt * Vector3d(std::cos(lean), std::sin(lean), 0)) *
              rotation_from_vector({0, 0, random.uniform(-M_PI, M_PI)}),
          distance_m * sight};
}

/// Image of the template for a pinhole camera: K [r1 r2 t] of the pixel's place on the plane.
Homography seen(const TargetPose& pose, const PlaneSize& size, const Camera& camera) {
  Matrix3d plane_from_template;  // pixel -> (X, Y, 1) in Target
  const double mx = size.width_m / size.width_px;
  const double my = size.height_m / size.height_px;
  plane_from_template << mx, 0, -mx * (size.width_px - 1) / 2, 0, my,
      -my * (size.height_px - 1) / 2, 0, 0, 1;
  Matrix3d P;
  P << pose.rotation.col(0), pose.rotation.col(1), pose.translation;
  return {camera.K() * P * plane_from_template};
}

/// Through the four corners as the camera shows them, lens and noise included.
std::optional<Homography> measured(const TargetPose& pose, const Camera& camera, double noise_px,
                                   test::Random& random) {
  const auto corners = corners_in_target(kPoster);
  const auto pixels = template_corners(kPoster.width_px, kPoster.height_px);
  std::vector<PixelPair> pairs;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d p = pose * corners[i];
    Pixel q = camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
    q.u += noise_px * random.normal();
    q.v += noise_px * random.normal();
    pairs.push_back({pixels[i], q});
  }
  return fit_homography(pairs);
}

double angle(const TargetPose& a, const TargetPose& b) {
  return rotation_vector(a.rotation.transpose() * b.rotation).norm();
}

/// True when the chosen pose is nearer to the truth than its rival.
bool is_right(const PlanePose& found, const TargetPose& truth) {
  return !found.rival || angle(found.camera_from_target, truth) <= angle(*found.rival, truth);
}

// 8 pixels over 0.8 m: the outer edges are 0.8 m apart, the outer pixel centres 0.7 m.
TEST(PlanePose, CornersArePixelCentresInTheTargetFrame) {
  const auto c = corners_in_target({8, 4, 0.8, 0.4});
  const std::array<Vector3d, 4> wanted{
      {{-0.35, -0.15, 0}, {0.35, -0.15, 0}, {0.35, 0.15, 0}, {-0.35, 0.15, 0}}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((c[i] - wanted[i]).norm(), 1e-15);
}

TEST(PlanePose, InvertsPlaneHomography) {
  test::Random random("inverts");
  for (int i = 0; i < 2000; ++i) {
    const double distance = 0.8 * std::exp(random.uniform(0, std::log(50)));
    const TargetPose truth =
        view(random, distance, random.uniform(0, 80) * kDegree, random.uniform(0, 25) * kDegree);
    const Homography H{random.uniform(-5, 5) * seen(truth, kPoster, kCamera).H};
    const auto found = plane_pose(H, kPoster, kCamera);
    ASSERT_TRUE(found);
    // A rounding of a pixel, 1e-13, turns a far and fronto-parallel plane by its square root at
    // worst; where the two minima merge the pose is flat in the error.
    EXPECT_LT(angle(found->camera_from_target, truth), 1e-6);
    EXPECT_LT((found->camera_from_target.translation - truth.translation).norm(), 1e-8 * distance);
    EXPECT_LT(found->reprojection_px, 1e-9);
    EXPECT_LT(rotation_defect(found->camera_from_target.rotation), 1e-12);
  }
}

// By hand: a plane 2 m straight ahead, its x to the right: 600 px * 0.8 m / 2 m = 240 px wide.
TEST(PlanePose, FrontoParallelByHand) {
  Homography H;
  H.H << 0.75, 0, 319.5 - 0.75 * 159.5, 0, 0.7375, 239.5 - 0.7375 * 119.5, 0, 0, 1;
  const auto found = plane_pose(H, kPoster, kCamera);
  ASSERT_TRUE(found);
  EXPECT_LT((found->camera_from_target.translation - Vector3d(0, 0, 2)).norm(), 1e-9);
  EXPECT_LT((found->camera_from_target.rotation - Matrix3d::Identity()).norm(), 1e-6);
}

// Square to the line of sight both tilts are the same pose.
TEST(PlanePose, NoRivalSquareToTheLineOfSight) {
  test::Random random("square");
  for (int i = 0; i < 100; ++i) {
    const TargetPose truth = view(random, 0.8 * random.uniform(1, 50), 0, random.uniform(0, 0.4));
    const auto found = plane_pose(seen(truth, kPoster, kCamera), kPoster, kCamera);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->rival);
    EXPECT_FALSE(found->ambiguous);
    EXPECT_LT(angle(found->camera_from_target, truth), 1e-5);
  }
}

/// RMS over the corners of how far a pose's corners are from the homography's, px.
double rms_px(const TargetPose& pose, const Homography& H, const Camera& camera) {
  const auto corners = corners_in_target(kPoster);
  const auto pixels = outline(H, kPoster.width_px, kPoster.height_px);
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d p = pose * corners[i];
    squares += std::pow(distance(camera.to_pixel({p.x() / p.z(), p.y() / p.z()}), pixels[i]), 2);
  }
  return std::sqrt(squares / 4);
}

TEST(PlanePose, BothAnswersAreMinimaOfTheReprojectionError) {
  test::Random random("minima");
  int rivals = 0;
  for (int i = 0; i < 200; ++i) {
    const TargetPose truth = view(random, 0.8 * random.uniform(3, 15),
                                  random.uniform(20, 70) * kDegree, random.uniform(0, 0.3));
    const auto H = measured(truth, kCamera, 0.5, random);
    ASSERT_TRUE(H);
    const auto found = plane_pose(*H, kPoster, kCamera);
    ASSERT_TRUE(found);
    const auto expect_minimum = [&](const TargetPose& pose, double reprojection_px) {
      EXPECT_NEAR(rms_px(pose, *H, kCamera), reprojection_px, 1e-9);
      for (int k = 0; k < 12; ++k) {
        const double sign = k % 2 == 0 ? 1 : -1;
        Vector3d shift = Vector3d::Zero();
        Vector3d turn = Vector3d::Zero();
        (k < 6 ? shift : turn)[k / 2 % 3] = sign * 1e-4;
        const TargetPose beside{rotation_from_vector(turn) * pose.rotation,
                                pose.translation + shift};
        EXPECT_GE(rms_px(beside, *H, kCamera), reprojection_px - 1e-9);
      }
    };
    expect_minimum(found->camera_from_target, found->reprojection_px);
    if (!found->rival) continue;
    ++rivals;
    expect_minimum(*found->rival, found->rival_reprojection_px);
    EXPECT_LE(found->reprojection_px, found->rival_reprojection_px);
  }
  EXPECT_GT(rivals, 150);  // nearly every view that is not close by has two
}

// Seen along the line of sight the rival leans as far to the other side.
TEST(PlanePose, RivalIsTheMirroredTilt) {
  test::Random random("mirrored");
  for (int i = 0; i < 100; ++i) {
    const double tilt = random.uniform(20, 60) * kDegree;
    const TargetPose truth = view(random, 0.8 * 20, tilt, random.uniform(0, 0.3));
    const auto found = plane_pose(seen(truth, kPoster, kCamera), kPoster, kCamera);
    ASSERT_TRUE(found && found->rival);
    const Vector3d sight = truth.translation.normalized();
    const Vector3d normal = truth.rotation.col(2);
    const Vector3d mirrored = 2 * sight * sight.dot(normal) - normal;
    // Exact for an infinitely far plane; its perspective (a fortieth) bends it by some degrees.
    EXPECT_LT(std::acos(std::fmin(1, mirrored.dot(found->rival->rotation.col(2)))), 5 * kDegree);
  }
}

// Up to five widths away (a target 120 px wide in this camera) perspective alone settles the choice
// between plane poses of 0.5 px of noise, but for one in thousands.
TEST(PlanePose, NearViewsNeedNoPreviousPose) {
  test::Random random("near");
  int right = 0;
  constexpr int kTrials = 500;
  for (int i = 0; i < kTrials; ++i) {
    const TargetPose truth = view(random, 0.8 * random.uniform(1, 5),
                                  random.uniform(15, 75) * kDegree, random.uniform(0, 0.35));
    const auto H = measured(truth, kCamera, 0.5, random);
    ASSERT_TRUE(H);
    const auto found = plane_pose(*H, kPoster, kCamera);
    ASSERT_TRUE(found);
    right += is_right(*found, truth) ? 1 : 0;
  }
  EXPECT_GE(right, kTrials * 99 / 100);
}

// Far away noise decides between the two errors, and the previous pose must: frame to frame a
// helicopter turns by degrees, the two solutions differ by tens.
TEST(PlanePose, PreviousPoseSettlesAmbiguousViews) {
  test::Random random("far");
  int right_alone = 0;
  int right = 0;
  constexpr int kTrials = 300;
  for (int i = 0; i < kTrials; ++i) {
    const TargetPose truth = view(random, 0.8 * random.uniform(15, 40),
                                  random.uniform(20, 60) * kDegree, random.uniform(0, 0.35));
    const auto H = measured(truth, kCamera, 0.5, random);
    ASSERT_TRUE(H);
    TargetPose previous = truth;
    previous.rotation *= rotation_from_vector(random.rotation_vector(3 * kDegree));
    const auto alone = plane_pose(*H, kPoster, kCamera);
    const auto found = plane_pose(*H, kPoster, kCamera, previous);
    ASSERT_TRUE(alone && found);
    EXPECT_EQ(alone->ambiguous, found->ambiguous);
    right_alone += is_right(*alone, truth) ? 1 : 0;
    right += is_right(*found, truth) ? 1 : 0;
  }
  EXPECT_LT(right_alone, kTrials * 80 / 100);
  EXPECT_GE(right, kTrials * 98 / 100);
}

// A wrong previous pose does not win against odds of more than 100 to 1.
TEST(PlanePose, EvidenceOverrulesAWrongPreviousPose) {
  test::Random random("overruled");
  int told_apart = 0;
  for (int i = 0; i < 200; ++i) {
    const TargetPose truth = view(random, 0.8 * random.uniform(2, 10),
                                  random.uniform(20, 60) * kDegree, random.uniform(0, 0.35));
    const auto H = measured(truth, kCamera, 0.1, random);
    ASSERT_TRUE(H);
    const auto alone = plane_pose(*H, kPoster, kCamera);
    ASSERT_TRUE(alone);
    if (!alone->rival) continue;
    const auto found = plane_pose(*H, kPoster, kCamera, alone->rival);
    ASSERT_TRUE(found);
    const double evidence =
        4 * (std::pow(alone->rival_reprojection_px, 2) - std::pow(alone->reprojection_px, 2)) /
        (0.5 * 0.5);
    const bool followed = angle(found->camera_from_target, *alone->rival) < 1e-9;
    EXPECT_EQ(followed, evidence <= 2 * std::log(100.0)) << evidence;
    EXPECT_EQ(found->ambiguous, followed);
    told_apart += followed ? 0 : 1;
  }
  EXPECT_GT(told_apart, 50);
}

/// Information the four corners give on (translation, rotation in Camera) for noise of one pixel,
/// by differences of the projection.
Eigen::Matrix<double, 6, 6> information(const TargetPose& pose, const Camera& camera) {
  const auto corners = corners_in_target(kPoster);
  Eigen::Matrix<double, 8, 6> J;
  for (int k = 0; k < 6; ++k) {
    constexpr double h = 1e-6;
    const auto project = [&](double step, std::size_t i) {
      Vector3d shift = Vector3d::Zero();
      Vector3d turn = Vector3d::Zero();
      (k < 3 ? shift : turn)[k % 3] = step;
      const Vector3d p =
          rotation_from_vector(turn) * pose.rotation * corners[i] + pose.translation + shift;
      const Pixel q = camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
      return Eigen::Vector2d(q.u, q.v);
    };
    for (std::size_t i = 0; i < 4; ++i) {
      J.block<2, 1>(Eigen::Index(2 * i), k) = (project(h, i) - project(-h, i)) / (2 * h);
    }
  }
  return J.transpose() * J;
}

// The error is what the corners' noise leaves open, no more (Cramer-Rao): e^T N e / sigma^2 has
// the mean 6 of chi-square with six degrees of freedom. Its standard deviation is sqrt(12), so the
// mean of 1000 is known to 0.11; five of them are allowed. Also through a strong lens.
void expect_efficient(const Camera& camera, double noise_px, test::Random& random) {
  double sum = 0;
  constexpr int kTrials = 1000;
  for (int i = 0; i < kTrials; ++i) {
    const TargetPose truth = view(random, 0.8 * random.uniform(1.5, 5),
                                  random.uniform(30, 65) * kDegree, random.uniform(0, 0.25));
    const auto H = measured(truth, camera, noise_px, random);
    ASSERT_TRUE(H);
    const auto found = plane_pose(*H, kPoster, camera, truth, {noise_px});
    ASSERT_TRUE(found);
    Eigen::Matrix<double, 6, 1> e;
    e << found->camera_from_target.translation - truth.translation,
        rotation_vector(found->camera_from_target.rotation * truth.rotation.transpose());
    sum += e.dot(information(truth, camera) * e) / (noise_px * noise_px);
  }
  EXPECT_NEAR(sum / kTrials, 6, 0.55);
}

TEST(PlanePose, ErrorIsWhatTheCornerNoisePredicts) {
  test::Random random("efficient");
  expect_efficient(kCamera, 0.3, random);
  expect_efficient(kCamera, 1.0, random);
  CameraParameters p = kCamera.parameters();
  p.lens = Lens::PlumbBob;
  p.distortion = {-0.3, 0.1, 1e-3, -1e-3, 0};
  expect_efficient(Camera(p), 0.5, random);
}

// Also through each lens the corners are where the camera shows them.
TEST(PlanePose, TakesTheLensOut) {
  test::Random random("lens");
  CameraParameters p = kCamera.parameters();
  for (const Lens lens : {Lens::PlumbBob, Lens::KannalaBrandt}) {
    p.lens = lens;
    p.distortion = {-0.2, 0.05, 1e-3, -1e-3, 0};
    if (lens == Lens::KannalaBrandt) p.distortion = {-0.03, 0.01, -0.004, 0.0007, 0};
    const Camera camera(p);
    for (int i = 0; i < 100; ++i) {
      const TargetPose truth = view(random, 0.8 * random.uniform(1.5, 10),
                                    random.uniform(10, 60) * kDegree, random.uniform(0, 0.25));
      const auto H = measured(truth, camera, 0, random);
      ASSERT_TRUE(H);
      const auto found = plane_pose(*H, kPoster, camera);
      ASSERT_TRUE(found);
      EXPECT_LT(angle(found->camera_from_target, truth), 1e-7);
      EXPECT_LT((found->camera_from_target.translation - truth.translation).norm(), 1e-7);
    }
  }
}

TEST(PlanePose, SameInputSameBits) {
  test::Random random("bits");
  const TargetPose truth = view(random, 8, 0.5, 0.1);
  const auto H = measured(truth, kCamera, 0.5, random);
  ASSERT_TRUE(H);
  const auto a = plane_pose(*H, kPoster, kCamera);
  const auto b = plane_pose(*H, kPoster, kCamera);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->camera_from_target.rotation, b->camera_from_target.rotation);
  EXPECT_EQ(a->camera_from_target.translation, b->camera_from_target.translation);
}

TEST(PlanePose, NoneFromWhatIsNoViewOfTheFront) {
  test::Random random("no view");
  const TargetPose truth = view(random, 3, 0.5, 0.1);
  const Homography good = seen(truth, kPoster, kCamera);
  ASSERT_TRUE(plane_pose(good, kPoster, kCamera));
  const auto expect_none = [](const Matrix3d& H, const char* what) {
    EXPECT_FALSE(plane_pose({H}, kPoster, kCamera)) << what;
  };
  expect_none(good.H * Eigen::DiagonalMatrix<double, 3>(-1, 1, 1), "mirrored");
  expect_none(Matrix3d::Zero(), "zero");
  expect_none(Vector3d(1, 0, 1).asDiagonal(), "a line");
  Matrix3d at_infinity = Matrix3d::Identity();
  at_infinity(2, 0) = -1.0 / 319;
  expect_none(at_infinity, "a side at infinity");
  Matrix3d behind = Matrix3d::Identity();
  behind(2, 0) = -1.0 / 200;
  expect_none(behind, "a side behind the camera");
  for (int i = 0; i < 9; ++i) {
    for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
      Matrix3d H = good.H;
      H(i) = bad;
      expect_none(H, "not finite");
    }
  }
}

TEST(PlanePose, NoneForAPlaneWithoutSize) {
  test::Random random("no size");
  const Homography H = seen(view(random, 3, 0.5, 0.1), kPoster, kCamera);
  for (const double bad : {0.0, -1.0, kNan}) {
    EXPECT_FALSE(plane_pose(H, {320, 240, bad, 0.6}, kCamera));
    EXPECT_FALSE(plane_pose(H, {320, 240, 0.8, bad}, kCamera));
    EXPECT_FALSE(plane_pose(H, {bad, 240, 0.8, 0.6}, kCamera));
    EXPECT_FALSE(plane_pose(H, {320, 1, 0.8, 0.6}, kCamera));
  }
}

TEST(PlanePose, NoneForCornersTheLensCannotShow) {
  CameraParameters p = kCamera.parameters();
  p.lens = Lens::PlumbBob;
  p.distortion = {-0.5, 0, 0, 0, 0};            // nothing appears more than 0.54 off the axis
  Matrix3d H = Vector3d(2, 2, 1).asDiagonal();  // 640 px wide, from the image's corner
  EXPECT_FALSE(plane_pose({H}, kPoster, Camera(p)));
  H.topRightCorner<2, 1>() << 319.5 - 200, 239.5 - 150;
  H.topLeftCorner<2, 2>() *= 0.6;
  EXPECT_TRUE(plane_pose({H}, kPoster, Camera(p)));
}

// Any nonsense gives an answer that is finite and in front, or none: never a throw, never NaN.
TEST(PlanePose, NonsenseNeverYieldsNonsense) {
  test::Random random("nonsense");
  TargetPose lost;
  lost.rotation.setConstant(kNan);
  for (int i = 0; i < 3000; ++i) {
    Matrix3d H;
    for (int k = 0; k < 9; ++k) H(k) = random.normal() * std::exp(random.uniform(-8, 8));
    const auto found = plane_pose({H}, kPoster, kCamera, lost);
    if (!found) continue;
    EXPECT_TRUE(found->camera_from_target.rotation.allFinite());
    EXPECT_TRUE(std::isfinite(found->reprojection_px));
    EXPECT_LT(rotation_defect(found->camera_from_target.rotation), 1e-9);
    for (const Vector3d& c : corners_in_target(kPoster)) {
      EXPECT_GT((found->camera_from_target * c).z(), 0);
    }
  }
}

TEST(PlanePose, OptionsRejectNoiseThatIsNone) {
  EXPECT_NO_THROW(PlanePoseOptions{}.check());
  EXPECT_NO_THROW(PlanePoseOptions{0}.check());
  EXPECT_THROW(PlanePoseOptions{-0.1}.check(), std::invalid_argument);
  EXPECT_THROW(PlanePoseOptions{kNan}.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
