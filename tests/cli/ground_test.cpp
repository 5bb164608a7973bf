// The ground station as an operator meets it: the real program flies the simulator, a real browser
// shows its page, and what goes out is heard at the other end of the link.
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "kestrel/link/command_receiver.hpp"
#include "kestrel/link/key_file.hpp"

#include "cli/browser.hpp"
#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

constexpr double kLong_s = 60;  // never waited out unless something is broken

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool comes(const std::function<bool()>& happens, double within_s = kLong_s) {
  for (const double start_s = now_s(); now_s() - start_s < within_s;) {
    if (happens()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

/// What the flight controller hears.
class Vehicle {
 public:
  Vehicle() : thread_([this] { listen(); }) {}
  ~Vehicle() {
    done_ = true;
    thread_.join();
  }
  Vehicle(const Vehicle&) = delete;
  Vehicle& operator=(const Vehicle&) = delete;

  std::string url() const { return to_string(receiver_.local()); }
  long heard() const { return heard_; }
  double speed_m_s() const { return speed_; }
  /// The largest speed since it was asked last.
  double fastest_m_s() { return fastest_.exchange(0); }
  /// When the first zero after something else was heard.
  double stopped_s() const { return stopped_s_; }

 private:
  void listen() {
    while (!done_) {
      for (const ReceivedCommand& received : receiver_.poll(0.02)) {
        const double speed = received.command.vector().norm();
        if (speed == 0 && speed_ > 0) stopped_s_ = now_s();
        speed_ = speed;
        if (speed > fastest_) fastest_ = speed;
        ++heard_;
      }
    }
  }

  CommandReceiver receiver_{Address{"127.0.0.1", 0}};
  std::atomic<bool> done_{false};
  std::atomic<long> heard_{0};
  std::atomic<double> speed_{0};
  std::atomic<double> fastest_{0};
  std::atomic<double> stopped_s_{0};
  std::thread thread_;
};

std::string hexadecimal(const mavlink::SigningKey& key) {
  std::string text;
  for (const std::uint8_t byte : key.bytes()) {
    constexpr const char* kDigits = "0123456789abcdef";
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

class Ground : public testing::Test {
 protected:
  void SetUp() override {
    if (!Browser::is_there()) GTEST_SKIP() << "no chromium or no chromium-driver on this machine";
    const mavlink::SigningKey key = mavlink::random_key();
    mavlink::write_key(folder_ / "token", key);
    program_ = std::make_unique<Program>(
        std::vector<std::string>{"simulate", KESTREL_SOURCE_DIR "/tasks/hover.yaml", "--ground",
                                 std::to_string(port_), "--ground-token", "token", "--sink",
                                 vehicle_.url(), "--no-video", "--output", "run"},
        folder_.path());
    browser_ = std::make_unique<Browser>(port_ + 2, folder_.path());
    const std::string page =
        "http://127.0.0.1:" + std::to_string(port_) + "/#token=" + hexadecimal(key);
    ASSERT_TRUE(comes([&] { return opens(page); })) << program_->wait(0).err;
  }

  /// False as long as nothing listens there.
  bool opens(const std::string& page) {
    try {
      browser_->go(page);
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  }
  bool says(const std::string& id, const std::string& words) {
    return comes([&] { return browser_->text(id).find(words) != std::string::npos; });
  }
  int frame() {
    return std::atoi(browser_->run("return +document.documentElement.dataset.frame || 0").c_str());
  }

  // Below the ports that the kernel hands out.
  const int port_ = 20000 + int(getpid() % 3000) * 4;
  const TempFolder folder_;
  Vehicle vehicle_;
  std::unique_ptr<Program> program_;
  std::unique_ptr<Browser> browser_;
};

TEST_F(Ground, AnOperatorStartsHoldsAViewAborts) {
  ASSERT_TRUE(comes([&] { return frame() > 0; })) << browser_->text("line");
  const int before = frame();
  EXPECT_TRUE(comes([&] { return frame() > before; })) << "the picture stands still";
  EXPECT_TRUE(says("sight", "Target seen"));
  EXPECT_TRUE(comes([&] { return vehicle_.heard() > 10; }));
  EXPECT_EQ(vehicle_.fastest_m_s(), 0) << "it moves before Start";

  browser_->click("take");
  ASSERT_TRUE(says("answer", "you have the command"));
  ASSERT_TRUE(comes([&] {
    return browser_->run("return !document.getElementById('start').disabled") == "true";
  }));
  browser_->click("start");
  ASSERT_TRUE(says("answer", "servoing"));
  EXPECT_TRUE(comes([&] { return vehicle_.speed_m_s() > 0.05; }));
  EXPECT_TRUE(says("mode", "Servoing"));

  browser_->click("hold_view");
  EXPECT_TRUE(says("answer", "is the goal"));
  EXPECT_TRUE(says("events", "is the goal"));
  // The helicopter brakes and comes back to where it was asked: the command falls to almost none.
  EXPECT_TRUE(comes([&] { return vehicle_.speed_m_s() < 0.05; }));
  EXPECT_TRUE(says("mode", "Servoing"));

  browser_->click("abort");
  ASSERT_TRUE(says("answer", "aborted"));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  vehicle_.fastest_m_s();
  const long heard = vehicle_.heard();
  EXPECT_TRUE(comes([&] { return vehicle_.heard() > heard + 20; }));
  EXPECT_EQ(vehicle_.fastest_m_s(), 0) << "an abort stays";
  EXPECT_TRUE(says("mode", "ABORTED"));
  EXPECT_EQ(browser_->run("return document.getElementById('start').disabled"), "true");
}

TEST_F(Ground, AnOperatorDrawsANewTemplate) {
  ASSERT_TRUE(comes([&] { return frame() > 0; })) << browser_->text("line");
  browser_->click("take");
  ASSERT_TRUE(says("answer", "you have the command"));
  ASSERT_TRUE(comes([&] {
    return browser_->run("return !document.getElementById('freeze').disabled") == "true";
  }));
  const auto at = nlohmann::json::parse(
      browser_->run("const b = document.getElementById('picture').getBoundingClientRect();"
                    "return [b.left, b.top, b.width, b.height]"));
  const auto place = [&](double share, int axis) {
    return int(at[std::size_t(axis)].get<double>() +
               share * at[std::size_t(axis) + 2].get<double>());
  };
  browser_->drag(place(0.35, 0), place(0.35, 1), place(0.65, 0), place(0.65, 1));
  ASSERT_TRUE(says("verdict", "keypoints")) << browser_->text("answer");
  browser_->click("use");
  ASSERT_TRUE(says("events", "new template")) << browser_->text("answer");
  EXPECT_TRUE(says("sight", "Target seen"));
  program_->signal(SIGINT);
  const Outcome outcome = program_->wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / "report.html"));
  EXPECT_EQ(outcome.err.find("token="), std::string::npos) << "a token of a file is not printed";
}

}  // namespace
}  // namespace kestrel::test
