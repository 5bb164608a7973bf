#include "kestrel/io/device_calls.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

TEST(SystemCalls, SayWhyADeviceDoesNotOpen) {
  EXPECT_EQ(system_calls().open("/dev/no-such-camera"), -1);
  EXPECT_EQ(errno, ENOENT);
}

TEST(SystemCalls, ReachAFileAsTheyWouldADevice) {
  const test::TempFolder folder;
  const auto file = folder.write("device", std::string(8192, 'x'));
  DeviceCalls& calls = system_calls();
  const int descriptor = calls.open(file.string());
  ASSERT_GE(descriptor, 0);
  EXPECT_NE(fcntl(descriptor, F_GETFL) & O_NONBLOCK, 0);
  EXPECT_EQ(calls.wait_readable(descriptor, 0), 1);
  int waiting = 0;
  EXPECT_EQ(calls.control(descriptor, FIONREAD, &waiting), 0);
  EXPECT_EQ(waiting, 8192);
  void* const bytes = calls.map(descriptor, 4096, 4096);
  ASSERT_NE(bytes, nullptr);
  EXPECT_EQ(std::memcmp(bytes, "xxxx", 4), 0);
  calls.unmap(bytes, 4096);
  calls.close(descriptor);
  EXPECT_EQ(calls.control(descriptor, FIONREAD, &waiting), -1);
  EXPECT_EQ(errno, EBADF);
}

TEST(SystemCalls, WaitNoLongerThanAskedAndTellWhatIsGone) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_EQ(system_calls().wait_readable(ends[0], 1), 0);
  EXPECT_EQ(write(ends[1], "1", 1), 1);
  EXPECT_EQ(system_calls().wait_readable(ends[0], 1000), 1);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 1);
  close(ends[1]);  // as a driver does when its camera is pulled out
  EXPECT_EQ(system_calls().wait_readable(ends[0], 1000), -1);
  EXPECT_EQ(errno, ENODEV);
  close(ends[0]);
}

TEST(SystemCalls, MapNothingThatIsNotThere) { EXPECT_EQ(system_calls().map(-1, 4096, 0), nullptr); }

}  // namespace
}  // namespace kestrel
