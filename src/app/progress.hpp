#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace kestrel::app {

/// One line on the terminal that tells how far a long job is; silent when stderr is no terminal.
class Progress {
 public:
  /// total: how many steps there are; empty when nobody knows. step: what one is called.
  explicit Progress(std::optional<std::int64_t> total, std::string step = "frame");
  /// Clears the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Redraws the line, ten times a second at most. what: a word on the state.
  void step(std::int64_t done, const std::string& what);
  /// Clears the line, so that something else can be printed; step() draws it again.
  void clear();

 private:
  std::optional<std::int64_t> total_;
  std::string step_;
  bool on_terminal_;
  double last_s_ = -1;
};

/// Seconds on a clock that only goes forward.
double monotonic_s();

/// The most memory that this program had resident so far, MB (a million bytes).
double peak_memory_mb();

}  // namespace kestrel::app
