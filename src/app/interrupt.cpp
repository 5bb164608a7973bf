#include "interrupt.hpp"

#include <atomic>
#include <csignal>

namespace kestrel::app {
namespace {

// A signal handler can reach nothing but a global: the one of this program.
std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch these");

void handle(int signal) {
  asked = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

bool interrupted() { return asked; }

}  // namespace kestrel::app
