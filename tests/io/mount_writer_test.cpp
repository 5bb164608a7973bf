#include "kestrel/io/mount_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/io/mount_file.hpp"

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

TEST(MountWriter, WhatIsWrittenIsReadBackToTheLastBit) {
  test::Random random("mount writer");
  const test::TempFolder folder;
  for (int i = 0; i < 20; ++i) {
    const Mount mount{rotation_from_vector(random.rotation_vector(3)), random.vector3(2)};
    const Mount back = load_mount(folder.write("m.yaml", mount_yaml(mount, {"a", "b"})));
    EXPECT_EQ(back.rotation, mount.rotation);
    EXPECT_EQ(back.translation, mount.translation);
  }
}

TEST(MountWriter, SaysInWordsWhatItMeans) {
  const std::string text = mount_yaml({}, {"By hand."});
  EXPECT_THAT(text, ::testing::StartsWith("# By hand.\n"));
  EXPECT_THAT(text, ::testing::HasSubstr("the camera looks down"));
}

}  // namespace
}  // namespace kestrel
