#include "kestrel/link/poller.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <sys/epoll.h>
#include <unistd.h>

#include "socket_address.hpp"

namespace kestrel {
namespace {

// Descriptors told in one call. More that are ready at the same time have their turn later, but
// never one of them twice before: the kernel goes round.
constexpr std::size_t kMost = 256;
constexpr double kLongestWait_s = 60;

int milliseconds(double seconds) {
  if (!(seconds > 0)) return 0;  // NaN too
  return int(std::ceil(std::min(seconds, kLongestWait_s) * 1000));
}

}  // namespace

Poller::Poller() : descriptor_(::epoll_create1(EPOLL_CLOEXEC)) {
  if (descriptor_ < 0) fail_at("epoll", "cannot wait for sockets");
  ready_.reserve(kMost);
}

Poller::Poller(Poller&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), ready_(std::move(other.ready_)) {}

Poller& Poller::operator=(Poller&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(ready_, other.ready_);
  return *this;
}

Poller::~Poller() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool Poller::watch(int descriptor, std::uint64_t tag, Interest interest) noexcept {
  epoll_event event{};
  event.events = EPOLLIN;
  if (interest == Interest::ReadAndWrite) event.events |= EPOLLOUT;
  event.data.u64 = tag;
  return ::epoll_ctl(descriptor_, EPOLL_CTL_MOD, descriptor, &event) == 0 ||
         ::epoll_ctl(descriptor_, EPOLL_CTL_ADD, descriptor, &event) == 0;
}

void Poller::forget(int descriptor) noexcept {
  ::epoll_ctl(descriptor_, EPOLL_CTL_DEL, descriptor, nullptr);
}

const std::vector<std::uint64_t>& Poller::wait(double timeout_s) noexcept {
  std::array<epoll_event, kMost> events;
  const int count =
      ::epoll_wait(descriptor_, events.data(), int(events.size()), milliseconds(timeout_s));
  ready_.clear();
  for (int i = 0; i < count; ++i) ready_.push_back(events[std::size_t(i)].data.u64);
  std::sort(ready_.begin(), ready_.end());
  return ready_;
}

}  // namespace kestrel
