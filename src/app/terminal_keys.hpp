#pragma once

#include <functional>
#include <string>
#include <thread>

namespace kestrel::app {

/// Single keys of the terminal on stdin, without Enter and not echoed; Ctrl-C and Ctrl-Z stay what
/// they are. Where stdin is no terminal nothing is changed and no key comes. A program in the
/// background of its terminal leaves the terminal alone until it is in the foreground.
///
/// The terminal is as before when this ends, when a signal ends the program, and while it is
/// suspended. At most one at a time.
class TerminalKeys {
 public:
  /// on_key is called by a thread of its own with what was typed at once: of a human one key, more
  /// when it was pasted.
  explicit TerminalKeys(std::function<void(const std::string& typed)> on_key);
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  /// Whether stdin is a terminal.
  static bool is_there();

 private:
  void run();

  std::function<void(const std::string&)> on_key_;
  int wake_ = -1;  // eventfd: the end
  std::thread thread_;
};

}  // namespace kestrel::app
