#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "kestrel/link/signing.hpp"

namespace kestrel::mavlink {

/// The signing times of one sender, of which none is ever given twice, however the program ended:
/// a file tells the last time that may have been given. It is written ahead, kReserve_s of them at
/// once, so that most times cost no disk. Each writing goes to a file of its own, to the disk, and
/// then takes the old one's place, so that after a crash there is the old number or the new one.
///
/// Times follow the clock. When the clock is behind what was given (after a crash by up to
/// kReserve_s, or when it was set back), they run ahead of it by one unit a time, and reserve
/// kReserveAhead_s only: a program that crashes again and again does not run away from the clock.
/// Receivers take times up to kFarthestAhead_s ahead of theirs.
///
/// next() and extend() may be called at the same time, each by one thread.
class TimestampStore {
 public:
  static constexpr double kReserve_s = 30;
  static constexpr double kReserveAhead_s = 1;

  /// Throws std::runtime_error, naming the file and the remedy, when the file holds anything but
  /// such a time, when its folder cannot be written, or when another process gives times from it
  /// (FILE.lock tells). A missing file is a first start.
  explicit TimestampStore(std::filesystem::path file);
  ~TimestampStore();
  TimestampStore(const TimestampStore&) = delete;
  TimestampStore& operator=(const TimestampStore&) = delete;

  /// A time later than all before, for a frame signed at unix_s (seconds since 1970). Empty when it
  /// would have to be reserved first and that fails (disk full), or in the year 2104. Waits for the
  /// disk when nothing is reserved: who must not wait lets another thread extend().
  std::optional<std::uint64_t> next(double unix_s);

  /// True when less than half of a reserve is left.
  bool is_low(double unix_s) const;

  /// Reserves times from unix_s on; waits for the disk. False when it cannot be written.
  bool extend(double unix_s);

  /// How far the next time is ahead of the clock; 0 when it is not. More than kReserve_s speaks of
  /// a clock that was wrong, once or now.
  double ahead_s(double unix_s) const;

 private:
  class Lock;

  std::uint64_t next_at(std::uint64_t now) const;

  std::filesystem::path file_;
  std::unique_ptr<Lock> lock_;
  std::mutex writing_;
  std::atomic<std::uint64_t> last_{0};      // given, or maybe given before the start
  std::atomic<std::uint64_t> reserved_{0};  // what the file says: none later was ever given
};

}  // namespace kestrel::mavlink
