#include "kestrel/io/rotating_log.hpp"

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/io/text_file.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(RotatingLog, KeepsEveryLineAndGoesOnAfterARestart) {
  const test::TempFolder folder;
  {
    RotatingLog log(folder / "log");
    log.write("one");
    log.write("two");
  }
  {
    RotatingLog log(folder / "log");
    log.write("three");
  }
  EXPECT_THAT(lines_of(folder / "log"), testing::ElementsAre("one", "two", "three"));
}

TEST(RotatingLog, NeverGrowsBeyondItsFiles) {
  const test::TempFolder folder;
  RotatingLogOptions options;
  options.max_bytes = 1000;
  options.files = 3;
  options.max_waiting = 100000;
  {
    RotatingLog log(folder / "log", options);
    for (int i = 0; i < 1000; ++i) log.write(std::to_string(100000 + i));
    EXPECT_EQ(log.dropped(), 0u);
  }
  std::vector<std::string> all;
  for (const char* name : {"log.2", "log.1", "log"}) {
    EXPECT_LE(fs::file_size(folder / name), options.max_bytes);
    for (const std::string& line : lines_of(folder / name)) all.push_back(line);
  }
  EXPECT_FALSE(fs::exists(folder / "log.3"));
  ASSERT_GT(all.size(), 2 * 142u);                // 142 lines of 7 bytes fill a file
  for (std::size_t i = 0; i < all.size(); ++i) {  // the newest, without a gap
    EXPECT_EQ(all[all.size() - 1 - i], std::to_string(100999 - i));
  }
}

TEST(RotatingLog, ADiskThatHangsDelaysNobody) {
  const test::TempFolder folder;
  RotatingLogOptions options;
  options.max_waiting = 10;
  std::uint64_t dropped = 0;
  const std::string line(500, 'x');
  {
    RotatingLog log(folder / "log", options);
    for (int i = 0; i < 100000 && log.dropped() == 0; ++i) log.write(line);
    dropped = log.dropped();
  }
  ASSERT_GT(dropped, 0u);
  const std::vector<std::string> lines = lines_of(folder / "log");
  EXPECT_THAT(lines.back(), testing::HasSubstr("lines dropped"));
}

TEST(RotatingLog, SaysWhatCannotBe) {
  const test::TempFolder folder;
  EXPECT_THROW(RotatingLog(folder / "no/folder"), FileError);
  RotatingLogOptions none;
  none.files = 0;
  EXPECT_THROW(none.check(), std::invalid_argument);
  RotatingLogOptions small;
  small.max_bytes = 10;
  EXPECT_THROW(small.check(), std::invalid_argument);
  RotatingLogOptions silent;
  silent.max_waiting = 0;
  EXPECT_THROW(silent.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
