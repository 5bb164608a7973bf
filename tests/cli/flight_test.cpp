// The built-in helicopter flown by the program itself, rendered images and real tracker included.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "kestrel/io/run_log.hpp"

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

std::string hover_task() { return (fs::path(KESTREL_SOURCE_DIR) / "tasks/hover.yaml").string(); }

TEST(Flight, DefaultStartConvergesToTheGoal) {
  const TempFolder folder;
  const Outcome outcome =
      Program({"simulate", hover_task(), "--no-video", "--output", "out"}, folder.path()).wait(300);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const LogFile log = read_log(folder.path() / "out/run.csv");
  const auto position = log.extra("position_error_m");
  const auto yaw = log.extra("true_yaw_rad");
  ASSERT_GT(position.size(), 60u);
  EXPECT_GT(position.front(), 3.0);
  for (std::size_t i = position.size() - 60; i < position.size(); ++i) {  // held for 2 s
    EXPECT_LE(position[i], 0.10);
    EXPECT_LE(std::abs(yaw[i]), 2 * M_PI / 180);
  }
}

TEST(Flight, TheSameRunWritesTheSameBytesAtAnyThreadCount) {
  const TempFolder folder;
  const auto fly = [&](const std::string& name, const std::string& threads) {
    const std::vector<std::string> words{"simulate",   hover_task(), "--duration", "1",
                                         "--no-video", "--output",   name};
    const Outcome outcome =
        Program(words, folder.path(), {"OPENCV_FOR_THREADS_NUM=" + threads}).wait(120);
    EXPECT_EQ(outcome.exit_code, 1);  // a second is too short to converge
    return read(folder.path() / name / "run.csv") + read(folder.path() / name / "trajectory.tum");
  };
  const std::string one = fly("one", "1");
  EXPECT_GT(one.size(), 10000u);
  EXPECT_EQ(one, fly("two", "2"));
}

TEST(Flight, AnotherSeedIsAnotherFlight) {
  const TempFolder folder;
  const auto fly = [&](const std::string& seed) {
    Program({"simulate", hover_task(), "--duration", "0.2", "--no-video", "--seed", seed,
             "--output", seed},
            folder.path())
        .wait(60);
    return read(folder.path() / seed / "run.csv");
  };
  EXPECT_NE(fly("1"), fly("2"));
}

}  // namespace
}  // namespace kestrel::test
