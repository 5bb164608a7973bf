#include "kestrel/io/mount_file.hpp"

#include <cmath>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpPoseVector.h>

#include "kestrel/geometry/mount_preset.hpp"
#include "kestrel/geometry/rotation.hpp"

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;
using test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::filesystem::path kCalib = std::filesystem::path(KESTREL_SOURCE_DIR) / "calib";

class MountFile : public ::testing::Test {
 protected:
  Mount load(const std::string& text) { return load_mount(folder_.write("m.yaml", text)); }
  std::string error_of(const std::string& text) {
    return message_of([&] { load(text); });
  }
  test::TempFolder folder_;
};

/// The camera's axes in the helicopter. cos(90 deg) is 6e-17 in doubles, hence the tolerance.
void expect_axes(const Mount& mount, const Vector3d& x, const Vector3d& y, const Vector3d& z) {
  EXPECT_TRUE(mount.rotation.col(0).isApprox(x, 1e-15)) << mount.rotation;
  EXPECT_TRUE(mount.rotation.col(1).isApprox(y, 1e-15)) << mount.rotation;
  EXPECT_TRUE(mount.rotation.col(2).isApprox(z, 1e-15)) << mount.rotation;
}

TEST(ShippedMounts, LookWhereTheirNamesSay) {
  const Vector3d forward = Vector3d::UnitX();
  const Vector3d right = Vector3d::UnitY();
  const Vector3d down = Vector3d::UnitZ();
  expect_axes(load_mount(kCalib / "mount_forward.yaml"), right, down, forward);
  expect_axes(load_mount(kCalib / "mount_down.yaml"), right, -forward, down);
  expect_axes(load_mount(kCalib / "mount_left.yaml"), forward, down, -right);
  expect_axes(load_mount(kCalib / "mount_forward_45_down.yaml"), right,
              std::sqrt(0.5) * (down - forward), std::sqrt(0.5) * (down + forward));
  EXPECT_EQ(load_mount(kCalib / "mount_forward.yaml").translation, Vector3d(0.30, 0, 0.10));
}

TEST_F(MountFile, GivesOneMountWhateverItsForm) {
  test::Random random("mount forms");
  for (int i = 0; i < 20; ++i) {
    const Vector3d t = random.vector3(2);
    const double roll = random.uniform(-180, 180);
    const double pitch = random.uniform(-85, 85);
    const double yaw = random.uniform(-180, 180);
    const double d = M_PI / 180;
    const Eigen::Matrix3d R = rotation_from_rpy(roll * d, pitch * d, yaw * d);
    char text[600];
    std::snprintf(text, sizeof text,
                  "translation_m: [%.17g, %.17g, %.17g]\nrpy_deg: [%.17g, %.17g, %.17g]\n", t.x(),
                  t.y(), t.z(), roll, pitch, yaw);
    const Mount from_angles = load(text);
    std::snprintf(text, sizeof text,
                  "translation_m: [%.17g, %.17g, %.17g]\nrotation:\n  - [%.17g, %.17g, %.17g]\n"
                  "  - [%.17g, %.17g, %.17g]\n  - [%.17g, %.17g, %.17g]\n",
                  t.x(), t.y(), t.z(), R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2),
                  R(2, 0), R(2, 1), R(2, 2));
    const Mount from_matrix = load(text);
    EXPECT_TRUE(from_angles.rotation.isApprox(R, 1e-14));
    EXPECT_TRUE(from_matrix.rotation.isApprox(R, 1e-14));
    EXPECT_EQ(from_angles.translation, t);
    EXPECT_EQ(from_matrix.translation, t);
  }
}

TEST_F(MountFile, ReadsARotationAsAxisTimesAngle) {
  // A turn of 120 deg about the diagonal takes x to y, y to z, z to x.
  const Mount mount = load(
      "translation_m: [0, 0, 0]\ntheta_u_deg: [69.2820323027551, "
      "69.2820323027551, 69.2820323027551]\n");
  EXPECT_TRUE(mount.rotation.col(0).isApprox(Vector3d::UnitY(), 1e-12)) << mount.rotation;
  EXPECT_THAT(error_of("translation_m: [0, 0, 0]\ntheta_u_deg: [0, 0, 0]\nrpy_deg: [0, 0, 0]\n"),
              HasSubstr("m.yaml:2: theta_u_deg: is given together with rpy_deg"));
}

TEST_F(MountFile, ReadsThePoseThatViSPWrites) {
  const vpPoseVector pose(0.1, -0.2, 0.3, 1.2, -0.5, 0.7);
  const std::string file = (folder_.path() / "eMc.yaml").string();
  ASSERT_TRUE(vpPoseVector::saveYAML(file, pose));
  const Mount mount = load_mount(file);
  const vpHomogeneousMatrix expected(pose);
  for (unsigned i = 0; i < 3; ++i) {
    // ViSP prints six significant digits.
    EXPECT_NEAR(mount.translation[i], expected[i][3], 1e-6);
    for (unsigned j = 0; j < 3; ++j) EXPECT_NEAR(mount.rotation(i, j), expected[i][j], 2e-6);
  }
}

TEST_F(MountFile, RefusesAMatrixThatIsNoRotation) {
  const auto matrix = [](const std::string& nine) {
    return "translation_m: [0, 0, 0]\nrotation: [" + nine + "]\n";
  };
  EXPECT_THAT(error_of(matrix("1, 0, 0, 0, 1, 0, 0, 0, 1.1")),
              AllOf(HasSubstr("m.yaml:2: rotation: is no rotation"),
                    HasSubstr("off the identity by 0.21"), HasSubstr("rpy_deg")));
  EXPECT_THAT(error_of(matrix("1, 0.1, 0, 0, 1, 0, 0, 0, 1")), HasSubstr("is no rotation"));
  EXPECT_THAT(error_of(matrix("1, 0, 0, 0, 1, 0, 0, 0, -1")), HasSubstr("mirror"));
  EXPECT_THAT(error_of(matrix("0, 0, 0, 0, 0, 0, 0, 0, 0")), HasSubstr("is no rotation"));
  EXPECT_THAT(error_of(matrix("1, 0, 0, 0, 1, 0, 0, 0")), HasSubstr("has 8 numbers; give 9"));
}

TEST_F(MountFile, ReadsAPresetHereOrThere) {
  for (const MountPreset preset : all_mount_presets()) {
    const std::string word = std::string("preset: ") + name(preset) + "\n";
    EXPECT_EQ(load(word).rotation, mount_rotation(preset));
    EXPECT_EQ(load(word).translation, Vector3d(0, 0, 0));
    EXPECT_EQ(load(word + "translation_m: [0.3, 0, 0.1]\n").translation, Vector3d(0.3, 0, 0.1));
  }
  EXPECT_THAT(error_of("preset: sideways\n"),
              AllOf(HasSubstr("m.yaml:1: preset"), HasSubstr("forward_45_down")));
  EXPECT_THAT(error_of("preset: down\ntranslation_m: [90, 0, 0]\n"), HasSubstr("90 m"));
}

TEST_F(MountFile, RefusesTwoRotationsAtOnce) {
  const std::string place = "translation_m: [0, 0, 0]\n";
  EXPECT_THAT(error_of("preset: down\n" + place + "rpy_deg: [0, 0, 90]\n"),
              HasSubstr("m.yaml:1: preset: is given together with rpy_deg; remove one"));
  EXPECT_THAT(error_of(place + "rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1]\npreset: down\n"),
              HasSubstr("m.yaml:3: preset: is given together with rotation"));
  EXPECT_THAT(error_of("preset: down\nrows: 6\ncols: 1\ndata: [0, 0, 0, 0, 0, 0]\n"),
              HasSubstr("preset: is given together with data"));
  EXPECT_THAT(error_of("rows: 6\ncols: 1\ndata: [0, 0, 0, 0, 0, 0]\n" + place),
              HasSubstr("m.yaml:3: data: is given together with translation_m"));
  EXPECT_THAT(error_of("rows: 6\ncols: 1\ndata: [0, 0, 0, 0, 0, 0]\nrpy_deg: [0, 0, 0]\n"),
              HasSubstr("m.yaml:3: data: is given together with rpy_deg"));
}

TEST_F(MountFile, RefusesWhatCanBeReadInTwoWays) {
  const std::string place = "translation_m: [0, 0, 0]\n";
  const auto error = [&](const std::string& line) { return error_of(place + line + "\n"); };
  const auto expect = [&](const std::string& key, const std::string& why) {
    EXPECT_THAT(error(key + ": [0, 0, 90]"),
                AllOf(HasSubstr("m.yaml:2: " + key + ": is ambiguous"), HasSubstr(why),
                      HasSubstr("Rz(yaw) Ry(pitch) Rx(roll)")));
    EXPECT_THAT(error("rpy_deg: [0, 0, 90]\n" + key + ": [0, 0, 1.5]"),
                HasSubstr("m.yaml:3: " + key + ": is ambiguous"));
    EXPECT_THAT(error("preset: down\n" + key + ": [0, 0, 1.5]"),
                HasSubstr("m.yaml:3: " + key + ": is ambiguous"));
  };
  for (const char* key :
       {"euler", "euler_deg", "euler_rad", "angles_deg", "angles_rad", "ypr_deg", "ypr_rad"})
    expect(key, "order");
  for (const char* key : {"rpy_rad", "theta_u_rad"}) expect(key, "radians are not read");
  for (const char* key : {"rpy", "theta_u"}) expect(key, "unit");
  for (const char* key : {"quaternion", "quaternion_xyzw", "quaternion_wxyz"})
    expect(key, "w first and w last");
  expect("camera_from_body", "inverse");
  expect("translation_mm", "metres");
}

TEST_F(MountFile, RefusesDegreesThatLookLikeRadians) {
  const auto error = [&](const std::string& angles) {
    return error_of("translation_m: [0, 0, 0]\nrpy_deg: [" + angles + "]\n");
  };
  EXPECT_THAT(error("1.5708, 0, 1.5708"),
              AllOf(HasSubstr("m.yaml:2: rpy_deg: looks like radians"), HasSubstr("give degrees")));
  EXPECT_THAT(error("0, 0, -3.1416"), HasSubstr("looks like radians"));
  EXPECT_EQ(error("1.6, 0, 90"), "nothing was thrown");
  EXPECT_EQ(error("0, 0, 0"), "nothing was thrown");
}

TEST_F(MountFile, TakesTheRotationNearestToRoundedNumbers) {
  const Mount m = load(
      "translation_m: [0, 0, 0]\n"
      "rotation: [0.866, -0.5, 0, 0.5, 0.866, 0, 0, 0, 1]\n");
  EXPECT_LT(rotation_defect(m.rotation), 1e-14);
  EXPECT_NEAR(m.rotation(0, 0), std::sqrt(0.75), 1e-4);  // three decimals were given
}

TEST_F(MountFile, RefusesWhatIsMissingTwofoldOrInOtherUnits) {
  EXPECT_THAT(error_of("rpy_deg: [0, 0, 0]\n"), HasSubstr("translation_m: is missing"));
  EXPECT_THAT(error_of("translation_m: [0, 0, 0]\n"), HasSubstr("rpy_deg: is missing"));
  EXPECT_THAT(error_of("translation_m: [0, 0, 0]\nrpy_deg: [0, 0, 0]\n"
                       "rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"),
              HasSubstr("m.yaml:3: rotation: is given together with rpy_deg"));
  EXPECT_THAT(error_of("translation_m: [300, 0, 100]\nrpy_deg: [0, 0, 0]\n"),
              HasSubstr("m.yaml:1: translation_m: puts the camera 316.2 m"));
  EXPECT_THAT(error_of("translation_m: [0, 0, 0]\nrpy_deg: [0, 0, 900]\n"), HasSubstr("360"));
  EXPECT_THAT(error_of("translation_m: [0, 0, 0]\nrpy_deg: [0, .nan, 0]\n"), HasSubstr("finite"));
  EXPECT_THAT(error_of("translation_m: [0, 0, 0]\nrpy_deg: [0, 0, 0]\nrpy_de: 1\n"),
              HasSubstr("m.yaml:3: rpy_de: is no key here; did you mean rpy_deg?"));
  EXPECT_THAT(error_of("rows: 4\ncols: 4\ndata: [1, 2, 3, 4, 5, 6]\n"), HasSubstr("give 6 rows"));
  EXPECT_THAT(error_of("rows: 6\ncols: 1\ndata: [1, 2]\n"), HasSubstr("has 2 numbers; give 6"));
}

TEST_F(MountFile, FollowsAFileNamedInTheSection) {
  folder_.write("sub/mount.yaml", "translation_m: [1, 2, 3]\nrpy_deg: [0, 0, 0]\n");
  EXPECT_EQ(load("file: sub/mount.yaml\n").translation, Vector3d(1, 2, 3));
  EXPECT_THAT(error_of("file: none.yaml\n"), HasSubstr("no such file"));
  EXPECT_THAT(error_of("file: sub/mount.yaml\nrpy_deg: [0, 0, 0]\n"),
              HasSubstr("rpy_deg: is no key"));
}

TEST(DescribeMount, SaysWhereItLooksAndSits) {
  EXPECT_EQ(
      describe(load_mount(kCalib / "mount_forward.yaml")),
      "the camera looks forward; image right is the helicopter's right; 0.30 m ahead of, 0.10 "
      "m below the reference point");
  EXPECT_THAT(describe(load_mount(kCalib / "mount_down.yaml")),
              HasSubstr("looks down; image right is the helicopter's right"));
  EXPECT_THAT(describe(load_mount(kCalib / "mount_left.yaml")),
              AllOf(HasSubstr("looks left; image right is the helicopter's front"),
                    HasSubstr("0.20 m left of the reference point")));
  Mount tilted;
  const double d = M_PI / 180;
  // Nose camera pitched 30 deg down: turned about the helicopter's right axis.
  tilted.rotation = rotation_from_rpy(0, -30 * d, 0) * rotation_from_rpy(90 * d, 0, 90 * d);
  EXPECT_THAT(describe(tilted), HasSubstr("looks forward, 30 deg towards down; image right is the "
                                          "helicopter's right; at the reference point"));
}

}  // namespace
}  // namespace kestrel
