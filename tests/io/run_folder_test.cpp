#include "kestrel/io/run_folder.hpp"

#include <fstream>
#include <set>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, TakesTheNextFreeNumber) {
  const test::TempFolder folder;
  EXPECT_EQ(create_run_folder(folder / "runs/comic"), folder / "runs/comic");
  EXPECT_EQ(create_run_folder(folder / "runs/comic"), folder / "runs/comic-2");
  EXPECT_EQ(create_run_folder(folder / "runs/comic/"), folder / "runs/comic-3");
  fs::remove(folder / "runs/comic-2");
  EXPECT_EQ(create_run_folder(folder / "runs/comic"), folder / "runs/comic-2");
}

TEST(RunFolder, NeverTakesWhatIsThere) {
  const test::TempFolder folder;
  std::ofstream(folder / "comic") << "a file";
  fs::create_symlink(folder / "nowhere", folder / "comic-2");
  EXPECT_EQ(create_run_folder(folder / "comic"), folder / "comic-3");
}

TEST(RunFolder, IsNeverGivenTwice) {
  const test::TempFolder folder;
  std::vector<std::vector<fs::path>> made(4);
  std::vector<std::thread> threads;
  for (auto& own : made)
    threads.emplace_back([&own, &folder] {
      for (int i = 0; i < 8; ++i) own.push_back(create_run_folder(folder / "race"));
    });
  for (std::thread& thread : threads) thread.join();
  std::set<fs::path> all;
  for (const auto& own : made) all.insert(own.begin(), own.end());
  EXPECT_EQ(all.size(), 32u);
}

TEST(RunFolder, TellsWhatToDo) {
  const test::TempFolder folder;
  std::ofstream(folder / "file") << "not a folder";
  for (const fs::path& path : {folder / "file/run", fs::path("/proc/run"), fs::path()}) {
    try {
      create_run_folder(path);
      ADD_FAILURE() << path;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("choose a folder that can be written"));
      EXPECT_THAT(error.what(), ::testing::HasSubstr(path.string()));
    }
  }
}

}  // namespace
}  // namespace kestrel
