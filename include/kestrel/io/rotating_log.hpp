#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>

namespace kestrel {

/// How much a log may grow.
struct RotatingLogOptions {
  std::uintmax_t max_bytes = 10'000'000;  // of one file; then the next is begun
  int files = 3;                          // FILE, and the older FILE.1, FILE.2 ...
  std::size_t max_waiting = 1000;         // lines that a slow disk may owe

  /// Throws std::invalid_argument that names the option.
  void check() const;
};

/// Lines for a file that never grows beyond all bounds, written by a thread of its own: whoever
/// has something to say never waits for a disk.
class RotatingLog {
 public:
  /// Goes on at the end of a file that is there. Throws FileError when it cannot be written,
  /// std::invalid_argument as the options do.
  explicit RotatingLog(std::filesystem::path file, const RotatingLogOptions& options = {});
  RotatingLog(const RotatingLog&) = delete;
  RotatingLog& operator=(const RotatingLog&) = delete;
  /// Writes what waits.
  ~RotatingLog();

  /// Puts a line at the end. When too many wait it is dropped, counted, and the count is a line of
  /// the log later.
  void write(std::string line);

  std::uint64_t dropped() const;

 private:
  void work();
  void put(const std::string& line);
  void rotate();

  std::filesystem::path file_;
  RotatingLogOptions options_;
  std::ofstream out_;
  std::uintmax_t size_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::string> waiting_;
  std::uint64_t dropped_ = 0;
  std::uint64_t untold_ = 0;  // of these, not in the log yet
  bool ends_ = false;
  std::thread writer_;
};

}  // namespace kestrel
