#pragma once

#include <memory>
#include <string>

#include "cli/program.hpp"

namespace kestrel::test {

/// A headless Chromium, driven as W3C's WebDriver says (w3.org/TR/webdriver2).
class Browser {
 public:
  /// False where Debian's chromium or chromium-driver is missing.
  static bool is_there();

  /// Starts one; its driver listens at this port. Throws std::runtime_error when it does not start.
  Browser(int driver_port, const std::filesystem::path& folder);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void go(const std::string& address);
  /// Clicks as a hand does: fails for what is hidden or covered.
  void click(const std::string& id);
  /// What a script of the page returns, JSON.
  std::string run(const std::string& script);
  /// The text of an element.
  std::string text(const std::string& id);
  /// Drags the pointer between two places of the window, px.
  void drag(int x0, int y0, int x1, int y1);
  /// A PNG in base64.
  std::string screenshot();

 private:
  std::string call(const std::string& path, const std::string& body);

  int port_;
  std::unique_ptr<Program> driver_;
  std::string session_;
};

}  // namespace kestrel::test
