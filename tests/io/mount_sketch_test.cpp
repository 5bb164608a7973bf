#include "kestrel/io/mount_sketch.hpp"

#include <gtest/gtest.h>

#include "kestrel/geometry/mount_preset.hpp"

namespace kestrel {
namespace {

std::string sketch(MountPreset preset) {
  Mount mount;
  mount.rotation = mount_rotation(preset);
  std::string all = "\n";
  for (const std::string& line : mount_sketch(mount)) all += line + "\n";
  return all;
}

TEST(MountSketch, LooksForward) {
  EXPECT_EQ(sketch(MountPreset::Forward), R"(
from above                 from the right
         nose                        up
           *
           .
left       o      right    tail       o . *   nose


         tail                       down
)");
}

TEST(MountSketch, LooksDown) {
  EXPECT_EQ(sketch(MountPreset::Down), R"(
from above                 from the right
         nose                        up


left       x      right    tail       o       nose
                                      .
                                      *
         tail                       down
)");
}

TEST(MountSketch, LooksLeft) {
  EXPECT_EQ(sketch(MountPreset::Left), R"(
from above                 from the right
         nose                        up


left   * . o      right    tail       x       nose


         tail                       down
)");
}

TEST(MountSketch, LooksForwardAndDown) {
  EXPECT_EQ(sketch(MountPreset::Forward45Down), R"(
from above                 from the right
         nose                        up
           *
           .
left       o      right    tail       o       nose
                                        .
                                          *
         tail                       down
)");
}

TEST(MountSketch, LooksUpToWhoIsAbove) {
  Mount mount;
  mount.rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1;  // its axis is the helicopter's up
  const auto lines = mount_sketch(mount);
  EXPECT_EQ(lines[4], "left       @      right    tail       o       nose");
  EXPECT_EQ(lines[2].back(), '*');
}

}  // namespace
}  // namespace kestrel
