#pragma once

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "kestrel/link/command_receiver.hpp"
#include "kestrel/link/key_file.hpp"

#include "cli/browser.hpp"
#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {

inline constexpr double kLong_s = 60;  // never waited out unless something is broken

inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline bool comes(const std::function<bool()>& happens, double within_s = kLong_s) {
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
  VelocityCommand command() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return command_;
  }
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
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          command_ = received.command;
        }
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
  mutable std::mutex mutex_;
  VelocityCommand command_;
  std::thread thread_;
};

inline std::string hexadecimal(const mavlink::SigningKey& key) {
  std::string text;
  for (const std::uint8_t byte : key.bytes()) {
    constexpr const char* kDigits = "0123456789abcdef";
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

/// A flight of the simulator with a page, and a browser that shows it.
class GroundVisit : public testing::Test {
 protected:
  void SetUp() override {
    if (!Browser::is_there()) GTEST_SKIP() << "no chromium or no chromium-driver on this machine";
    const mavlink::SigningKey key = mavlink::random_key();
    mavlink::write_key(folder_ / "token", key);
    start_program();
    browser_ = std::make_unique<Browser>(port_ + 2, folder_.path());
    const std::string page =
        "http://127.0.0.1:" + std::to_string(port_) + "/#token=" + hexadecimal(key);
    ASSERT_TRUE(comes([&] { return opens(page); })) << program_->wait(0).err;
  }

  void start_program() {
    program_ = std::make_unique<Program>(
        std::vector<std::string>{"simulate", KESTREL_SOURCE_DIR "/tasks/hover.yaml", "--ground",
                                 std::to_string(port_), "--ground-token", "token", "--sink",
                                 vehicle_.url(), "--no-video", "--output", "run"},
        folder_.path());
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
  bool is_true(const std::string& expression) {
    return comes([&] { return browser_->run("return " + expression) == "true"; });
  }
  void take_command() {
    ASSERT_TRUE(comes([&] { return frame() > 0; })) << browser_->text("line");
    browser_->click("take");
    ASSERT_TRUE(says("answer", "you have the command"));
    ASSERT_TRUE(is_true("!document.getElementById('dead_man').disabled"));
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

}  // namespace kestrel::test
