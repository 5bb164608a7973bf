#include "progress.hpp"

#include <chrono>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

namespace kestrel::app {

double monotonic_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024 / 1e6;  // Linux counts kilobytes
}

Progress::Progress(std::optional<std::int64_t> total, std::string step)
    : total_(total), step_(std::move(step)), on_terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (on_terminal_ && last_s_ >= 0) std::fputs("\r\x1b[K", stderr);
  last_s_ = -1;
}

void Progress::step(std::int64_t done, const std::string& what) {
  if (!on_terminal_) return;
  const double now = monotonic_s();
  if (last_s_ >= 0 && now - last_s_ < 0.1) return;
  last_s_ = now;
  const std::string of = total_ ? fmt::format(" of {}", *total_) : "";
  fmt::print(stderr, "\r\x1b[K{} {}{}  {}", step_, done, of, what);
  std::fflush(stderr);
}

}  // namespace kestrel::app
