#include "kestrel/link/status_server.hpp"

#include <atomic>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using testing::HasSubstr;

class StatusServerTest : public testing::Test {
 protected:
  test::TempFolder folder_;
  std::filesystem::path path_ = folder_ / "status";
};

TEST_F(StatusServerTest, AnswersWhoAsks) {
  StatusServer server(path_);
  EXPECT_FALSE(server.answer([] { return std::string("nobody asked"); }));
  const std::string text(50000, 'x');  // more than a page of a full switch
  std::atomic<bool> done{false};
  std::thread serving([&] {
    pollfd wanted{server.descriptor(), POLLIN, 0};
    while (!done) {
      if (::poll(&wanted, 1, 10) == 1) server.answer([&] { return text; });
    }
  });
  EXPECT_EQ(ask_status(path_, 5), text);
  EXPECT_EQ(ask_status(path_, 5), text);
  done = true;
  serving.join();
}

TEST_F(StatusServerTest, IsForThisUserOnly) {
  const StatusServer server(path_);
  struct stat found {};
  ASSERT_EQ(::stat(path_.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777, 0600);
}

TEST_F(StatusServerTest, LeavesNoFileAndTakesTheFileOfWhoIsGone) {
  { const StatusServer server(path_); }
  EXPECT_FALSE(std::filesystem::exists(path_));
  {
    const StatusServer server(path_);
    std::filesystem::rename(path_, folder_ / "kept");  // as after a crash
  }
  std::filesystem::rename(folder_ / "kept", path_);
  EXPECT_THAT(test::message_of([&] { ask_status(path_, 1); }), HasSubstr("no switch answers"));
  EXPECT_NO_THROW(StatusServer{path_});
}

TEST_F(StatusServerTest, TakesNobodysPlace) {
  const StatusServer server(path_);
  EXPECT_THAT(test::message_of([&] { const StatusServer other(path_); }),
              HasSubstr("another program listens"));
  folder_.write("file", "precious");
  EXPECT_THAT(test::message_of([&] { const StatusServer other(folder_ / "file"); }),
              HasSubstr("is no socket"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "file"));
  EXPECT_THAT(test::message_of([&] { const StatusServer other(folder_ / std::string(200, 'x')); }),
              HasSubstr("at most 107 characters"));
  EXPECT_THROW(StatusServer(folder_ / "no/such/folder"), std::runtime_error);
}

TEST_F(StatusServerTest, AskingASwitchThatHangsComesToAnEnd) {
  const StatusServer server(path_);  // answers nobody
  EXPECT_THROW(ask_status(path_, 0.05), std::runtime_error);
  EXPECT_THROW(ask_status(folder_ / "nothing", 0.05), std::runtime_error);
}

}  // namespace
}  // namespace kestrel
