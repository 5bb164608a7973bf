#include "kestrel/link/timestamp_store.hpp"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::mavlink {
namespace {

using std::filesystem::path;
using testing::HasSubstr;

constexpr double kNow_s = 1.8e9;  // in the year 2027

std::string failure(const path& file) {
  return test::message_of([&] { const TimestampStore store(file); });
}

std::string text_of(const path& file) {
  std::ifstream stream(file);
  std::string text;
  std::getline(stream, text);
  return text;
}

TEST(TimestampStore, FollowsTheClockAndNeverStandsStill) {
  const test::TempFolder folder(test::memory_folder());
  TimestampStore store(folder / "times");
  test::Random random("clock");
  std::uint64_t last = 0;
  double clock_s = kNow_s;
  for (int i = 0; i < 2000; ++i) {
    clock_s += random.integer(0, 99) == 0 ? random.uniform(-5, 5) : random.uniform(0, 0.01);
    const auto time = store.next(clock_s);
    ASSERT_TRUE(time);
    EXPECT_GT(*time, last);
    EXPECT_EQ(*time, std::max(last + 1, signing_time(clock_s)));
    last = *time;
  }
}

TEST(TimestampStore, GoesOnLaterThanBefore) {
  const test::TempFolder folder(test::memory_folder());
  std::uint64_t last = 0;
  for (int i = 0; i < 5; ++i) {
    TimestampStore store(folder / "times");
    const auto time = store.next(kNow_s - 10 * i);  // and the clock goes back
    ASSERT_TRUE(time);
    EXPECT_GT(*time, last);
    last = *time;
  }
}

TEST(TimestampStore, DoesNotRunAwayFromTheClockWhenItCrashesAgainAndAgain) {
  const test::TempFolder folder(test::memory_folder());
  for (int i = 0; i < 20; ++i) {
    TimestampStore store(folder / "times");
    // 30 s once, and a second each time it starts at the same moment; half a unit for rounding.
    EXPECT_LE(store.ahead_s(kNow_s), i == 0 ? 0 : 30 + 1.00003 * i);
    EXPECT_GE(store.ahead_s(kNow_s), i == 0 ? 0 : 30 + 0.99 * (i - 1));
    EXPECT_EQ(store.ahead_s(kNow_s + 100), 0);
    ASSERT_TRUE(store.next(kNow_s));
  }
}

TEST(TimestampStore, WritesRarely) {
  const test::TempFolder folder(test::memory_folder());
  TimestampStore store(folder / "times");
  int writings = 0;
  std::string before;
  for (int i = 0; i < 6000; ++i) {  // a minute at 100 frames a second
    ASSERT_TRUE(store.next(kNow_s + 0.01 * i));
    if (i % 100 != 0) continue;
    const std::string now = text_of(folder / "times");
    writings += now != before ? 1 : 0;
    before = now;
  }
  EXPECT_LE(writings, 3);
  EXPECT_GE(std::stoull(before), signing_time(kNow_s + 59.99));
}

TEST(TimestampStore, NeedNotWaitForTheDiskWhenExtendedInTime) {
  const test::TempFolder folder(test::memory_folder());
  std::filesystem::create_directory(folder / "sub");
  TimestampStore store(folder / "sub" / "times");
  EXPECT_TRUE(store.is_low(kNow_s));
  EXPECT_TRUE(store.extend(kNow_s));
  EXPECT_FALSE(store.is_low(kNow_s));
  EXPECT_FALSE(store.is_low(kNow_s + 14.9));
  EXPECT_TRUE(store.is_low(kNow_s + 15.1));
  std::filesystem::remove_all(folder / "sub");  // no disk from here on
  EXPECT_FALSE(store.extend(kNow_s + 15.1));
  EXPECT_TRUE(store.next(kNow_s + 29.9));
  EXPECT_FALSE(store.next(kNow_s + 30.1));
}

TEST(TimestampStore, IsExtendedByAnotherThread) {
  const test::TempFolder folder(test::memory_folder());
  TimestampStore store(folder / "times");
  std::thread other([&] {
    for (int i = 0; i < 40; ++i) store.extend(kNow_s + 10 * i);
  });
  std::uint64_t last = 0;
  for (int i = 0; i < 40; ++i) {
    const auto time = store.next(kNow_s + 10 * i);
    EXPECT_TRUE(time && *time > last);
    last = time.value_or(last);
  }
  other.join();
  EXPECT_GE(std::stoull(text_of(folder / "times")), last);
}

TEST(TimestampStore, BelongsToOneProcess) {
  const test::TempFolder folder(test::memory_folder());
  {
    const TimestampStore store(folder / "times");
    EXPECT_THAT(failure(folder / "times"), HasSubstr("times: another process signs"));
    EXPECT_EQ(failure(folder / "others"), "nothing was thrown");
  }
  EXPECT_EQ(failure(folder / "times"), "nothing was thrown");
}

TEST(TimestampStore, RefusesAFileThatIsNoTime) {
  const test::TempFolder folder(test::memory_folder());
  for (const char* text : {"", "\n", "12", "12 \n", "-1\n", "x\n", "1\n2\n", "281474976710656\n",
                           "99999999999999999999999999999999999999999\n"}) {
    EXPECT_THAT(failure(folder.write("times", text)), HasSubstr("times: holds no signing time"));
  }
  EXPECT_EQ(failure(folder.write("times", "281474976710655\n")), "nothing was thrown");
  EXPECT_THAT(failure(folder / "no" / "folder"), HasSubstr("folder.lock: cannot be made"));
}

TEST(TimestampStore, EndsInTheYear2104) {
  const test::TempFolder folder(test::memory_folder());
  TimestampStore store(folder.write("times", "281474976710654\n"));
  EXPECT_EQ(store.next(kNow_s), kLastSigningTime);
  EXPECT_FALSE(store.next(kNow_s));
}

/// Gives times as fast as it can, a writing every few of them, and tells each before the next one.
[[noreturn]] void give_times(const path& file, double start_s, int to) {
  try {
    TimestampStore store(file);
    for (double clock_s = start_s;; clock_s += 5) {
      const auto time = store.next(clock_s);
      if (!time || ::write(to, &*time, sizeof *time) != ssize_t(sizeof *time)) ::_exit(1);
    }
  } catch (...) {
    ::_exit(1);
  }
}

TEST(TimestampStore, GivesNoTimeTwiceThoughItIsKilledAtAnyMoment) {
  const test::TempFolder folder(test::memory_folder());
  test::Random random("kill");
  std::uint64_t last = 0;
  int given = 0;
  for (int round = 0; round < 60; ++round) {
    int ends[2] = {};
    ASSERT_EQ(::pipe(ends), 0);
    // The clock goes on about where it was, or is set back.
    const double last_s = 1420070400 + double(last) / kSigningUnits_per_s;
    const double start_s = std::max(kNow_s, last_s) + random.uniform(-40, 10);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) give_times(folder / "times", start_s, ends[1]);
    ::close(ends[1]);
    ::usleep(useconds_t(random.integer(0, 2000)));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));  // it never failed by itself
    std::uint64_t time = 0;
    for (; ::read(ends[0], &time, sizeof time) == ssize_t(sizeof time); ++given) {
      ASSERT_GT(time, last) << "round " << round;
      last = time;
    }
    ::close(ends[0]);
  }
  EXPECT_GT(given, 60);
}

}  // namespace
}  // namespace kestrel::mavlink
