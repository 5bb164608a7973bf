#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

namespace kestrel {

/// One place for the newest of many values: who puts never waits for who takes, and who takes late
/// gets the newest and misses those between. Shared by one who puts and any number who take; a
/// value lives as long as one of them holds it.
template <class T>
class LatestValue {
 public:
  /// A value and its number, counted from 1; 0 and null when there is none.
  struct Numbered {
    std::uint64_t number = 0;
    std::shared_ptr<const T> value;
  };

  /// Takes the place of the value before; the lock is held for a swap of two pointers.
  void put(std::shared_ptr<const T> value) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      value.swap(now_.value);
      ++now_.number;
    }
    changed_.notify_all();  // and the old value ends here, outside of the lock
  }

  Numbered now() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return now_;
  }

  /// The newest value once it is newer than number `known`; none when timeout_s passes first, or
  /// the place is closed.
  Numbered newer_than(std::uint64_t known, double timeout_s) const {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                      [&] { return closed_ || now_.number > known; });
    return closed_ || now_.number <= known ? Numbered{} : now_;
  }

  /// No more values: wakes all who wait.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

  bool is_closed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return closed_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Numbered now_;
  bool closed_ = false;
};

}  // namespace kestrel
