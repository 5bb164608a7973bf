#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace kestrel {

/// Waits for many descriptors at once (Linux epoll, level-triggered: what is not served is told
/// again). Owns no descriptor but its own; one that is closed is forgotten by the kernel.
class Poller {
 public:
  /// What is to be waited for.
  enum class Interest { Read, ReadAndWrite };

  /// Throws std::runtime_error when the system has no room for it.
  Poller();
  Poller(Poller&& other) noexcept;
  Poller& operator=(Poller&& other) noexcept;
  Poller(const Poller&) = delete;
  Poller& operator=(const Poller&) = delete;
  ~Poller();

  /// From now on the descriptor is waited for; `tag` is what wait() calls it. False when the system
  /// refuses.
  bool watch(int descriptor, std::uint64_t tag, Interest interest = Interest::Read) noexcept;

  void forget(int descriptor) noexcept;

  /// The tags of all that is ready, or has failed, by rising tag: who is served first is decided
  /// by the tags. Waits up to timeout_s, rounded up to whole milliseconds; empty after that or a
  /// signal. Good until the next call.
  const std::vector<std::uint64_t>& wait(double timeout_s) noexcept;

 private:
  int descriptor_ = -1;
  std::vector<std::uint64_t> ready_;
};

}  // namespace kestrel
