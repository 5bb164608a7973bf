#pragma once

#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "kestrel/link/key_file.hpp"

#include "cli/browser.hpp"
#include "cli/program.hpp"
#include "cli/wire_listener.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {

inline constexpr double kLong_s = 60;  // never waited out unless something is broken

inline bool comes(const std::function<bool()>& happens, double within_s = kLong_s) {
  for (const double start_s = now_s(); now_s() - start_s < within_s;) {
    if (happens()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

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
    browser_ = std::make_unique<Browser>(port_ + 3, folder_.path());
    const std::string page =
        "http://127.0.0.1:" + std::to_string(port_) + "/#token=" + hexadecimal(key);
    ASSERT_TRUE(comes([&] { return opens(page); })) << program_->wait(0).err;
  }

  void start_program() {
    std::vector<std::string> arguments{"simulate",
                                       KESTREL_SOURCE_DIR "/tasks/hover.yaml",
                                       "--ground",
                                       std::to_string(port_),
                                       "--ground-token",
                                       "token",
                                       "--no-video",
                                       "--output",
                                       "run"};
    const auto more = more_arguments();
    arguments.insert(arguments.end(), more.begin(), more.end());
    program_ = std::make_unique<Program>(arguments, folder_.path());
  }
  /// Where commands go, as arguments.
  virtual std::vector<std::string> more_arguments() { return {"--sink", vehicle_.url()}; }

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
  WireListener vehicle_;
  std::unique_ptr<Program> program_;
  std::unique_ptr<Browser> browser_;
};

}  // namespace kestrel::test
