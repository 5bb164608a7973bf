#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace kestrel::test {

/// A finger on the screen, px of the window; it keeps its id until it is lifted.
struct Finger {
  int id = 0;
  double x = 0;
  double y = 0;
};

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
  /// Puts a hand on a place of the window and keeps it there, px; then slides it; then lets go.
  void press(int x, int y);
  void slide(int x, int y);
  void let_go();
  /// A key of the keyboard, down or up: a letter, or a code of WebDriver's for others.
  void key_down(const std::string& key);
  void key_up(const std::string& key);
  /// Gives the page a screen of this size, px: a telephone's where it is narrow.
  void screen(int width, int height);
  /// The same with fingers: it has no mouse that could rest over something.
  void touch_screen(int width, int height);
  /// What fingers do on it (DevTools protocol, Input.dispatchTouchEvent): "touchStart" and
  /// "touchMove" with all that are on it then, "touchEnd" with those that are lifted (none: all),
  /// "touchCancel" with none.
  void touch(const std::string& what, const std::vector<Finger>& fingers);
  /// A short touch in the middle of an element.
  void tap(const std::string& id);
  /// Ends the browser as a power cut does: its pages are told nothing.
  void crash();
  /// A PNG in base64.
  std::string screenshot();

 private:
  void devtools(const std::string& command, const std::string& parameters);
  void act(const std::string& actions);
  std::string call(const std::string& path, const std::string& body);

  int port_;
  std::unique_ptr<Program> driver_;
  std::string session_;
};

}  // namespace kestrel::test
