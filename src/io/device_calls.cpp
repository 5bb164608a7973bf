#include "kestrel/io/device_calls.hpp"

#include <cerrno>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace kestrel {
namespace {

class SystemCalls final : public DeviceCalls {
 public:
  int open(const std::string& path) override {
    return ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  void close(int descriptor) override { ::close(descriptor); }
  int control(int descriptor, unsigned long request, void* argument) override {
    int result = -1;
    do {
      result = ::ioctl(descriptor, request, argument);
    } while (result == -1 && errno == EINTR);
    return result;
  }
  void* map(int descriptor, std::size_t bytes, std::size_t offset) override {
    void* const start =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, off_t(offset));
    return start == MAP_FAILED ? nullptr : start;
  }
  void unmap(void* start, std::size_t bytes) override { ::munmap(start, bytes); }
  int wait_readable(int descriptor, int wait_ms) override {
    pollfd waited{descriptor, POLLIN, 0};
    const int ready = ::poll(&waited, 1, wait_ms);
    if (ready < 0) return errno == EINTR ? 0 : -1;
    if (ready == 0 || (waited.revents & POLLIN) != 0) return ready;
    // POLLHUP, POLLNVAL: taken away. POLLERR alone is a stream that stands still: asking for a
    // picture will say why.
    if ((waited.revents & (POLLHUP | POLLNVAL)) == 0) return 1;
    errno = ENODEV;
    return -1;
  }
};

}  // namespace

DeviceCalls& system_calls() {
  static SystemCalls calls;  // empty: nothing that one user could change for another
  return calls;
}

}  // namespace kestrel
