#include "kestrel/io/timing_log.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

TEST(TimingLog, KeepsMicroseconds) {
  const test::TempFolder folder;
  TimingLog log(folder / "timing.csv", {"track", "pose"});
  log.write(3, {12.3456, std::nan("")});
  std::ostringstream text;
  text << std::ifstream(folder / "timing.csv").rdbuf();
  EXPECT_EQ(text.str(), "frame,track_ms,pose_ms\n3,12.346,\n");
}

TEST(TimingLog, RefusesAnotherNumberOfTimes) {
  const test::TempFolder folder;
  TimingLog log(folder / "timing.csv", {"track"});
  EXPECT_THROW(log.write(0, {1, 2}), std::invalid_argument);
  EXPECT_THROW(log.write(0, {}), std::invalid_argument);
  EXPECT_THROW(TimingLog("/dev/full", {"track"}), std::runtime_error);
}

}  // namespace
}  // namespace kestrel
