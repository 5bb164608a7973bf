#include "kestrel/io/stamps_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

std::string error_of(const std::string& text) {
  const test::TempFolder folder;
  const auto file = folder.write("stamps.csv", text);
  return test::message_of([&] { load_stamps(file); });
}

TEST(LoadStamps, ReadsFrameAndTime) {
  const test::TempFolder folder;
  const auto file = folder.write("s.csv", "frame,stamp_s\n0,0.5\r\n3,0.625\n");
  EXPECT_THAT(load_stamps(file), ElementsAre(Pair(0, 0.5), Pair(3, 0.625)));
}

TEST(LoadStamps, NamesTheLineThatIsWrong) {
  EXPECT_THAT(error_of("frame,time\n"), HasSubstr("stamps.csv:1: the first line must be"));
  EXPECT_THAT(error_of("frame,stamp_s\n0,1\n1\n"), HasSubstr("stamps.csv:3: is no"));
  EXPECT_THAT(error_of("frame,stamp_s\n0,nan\n"), HasSubstr("stamps.csv:2: is no"));
  EXPECT_THAT(error_of("frame,stamp_s\n0.5,1\n"), HasSubstr("stamps.csv:2: is no"));
  EXPECT_THAT(error_of("frame,stamp_s\n1,1\n1,2\n"), HasSubstr("stamps.csv:3: frame and stamp"));
  EXPECT_THAT(error_of("frame,stamp_s\n1,1\n2,1\n"), HasSubstr("stamps.csv:3: frame and stamp"));
}

}  // namespace
}  // namespace kestrel
