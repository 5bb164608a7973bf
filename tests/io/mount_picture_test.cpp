#include "kestrel/io/mount_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/mount_preset.hpp"

#include "io/svg_vertices.hpp"
#include "support/markup_check.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Mount mount_of(MountPreset preset) { return {mount_rotation(preset), {0.3, 0, 0.1}}; }

/// The ends of the lines of the camera's field of view in the first (side) view of a picture, px:
/// the closed outline's vertices.
std::vector<Eigen::Vector2d> field_of_view(const std::string& svg) { return test::first_line(svg); }

Eigen::Vector2d middle(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& p : points) sum += p / double(points.size());
  return sum;
}

TEST(MountPicture, IsWellFormedForEveryPreset) {
  for (const MountPreset preset : all_mount_presets()) {
    const std::string svg = mount_picture(mount_of(preset), std::nullopt);
    EXPECT_EQ(test::markup_fault(svg), "");
    for (const char* words : {"From its right side", "From above", "body", "camera", "unknown"})
      EXPECT_THAT(svg, HasSubstr(words));
  }
}

TEST(MountPicture, DrawsTheFieldOfViewWhereTheCameraLooks) {
  const auto seen = [](MountPreset preset) {
    return middle(field_of_view(mount_picture(mount_of(preset), std::nullopt)));
  };
  // From the right side the nose is to the right and down is down. The pictures have their own
  // scales: compare directions only.
  EXPECT_GT(seen(MountPreset::Forward).x(), 330);  // right of the middle, 280 px
  EXPECT_GT(seen(MountPreset::Down).y(), 190);     // in the lower half of 300 px
  const Eigen::Vector2d tilted = seen(MountPreset::Forward45Down);
  EXPECT_GT(tilted.x(), 300);
  EXPECT_GT(tilted.y(), 170);
}

TEST(MountPicture, DrawsTheCamerasOwnField) {
  const Camera wide({200, 200, 319.5, 239.5, 640, 480});
  const Camera narrow({2000, 2000, 319.5, 239.5, 640, 480});
  const auto height = [](const Camera& camera) {
    const std::string svg = mount_picture(mount_of(MountPreset::Forward), camera);
    EXPECT_THAT(svg, Not(HasSubstr("unknown")));
    double low = 1e9;
    double high = -1e9;
    for (const auto& p : field_of_view(svg)) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
    }
    return high - low;
  };
  EXPECT_GT(height(wide), 3 * height(narrow));
}

TEST(MountPicture, DrawsAFisheyeAsFarAsItSees) {
  CameraParameters p{200, 200, 319.5, 239.5, 640, 480, Lens::KannalaBrandt};
  const std::string svg = mount_picture(mount_of(MountPreset::Down), Camera(p));
  EXPECT_EQ(test::markup_fault(svg), "");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace kestrel
