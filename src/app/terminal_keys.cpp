#include "terminal_keys.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <poll.h>
#include <sys/eventfd.h>
#include <termios.h>
#include <unistd.h>

namespace kestrel::app {
namespace {

constexpr int kLook_ms = 200;  // how often a program looks whether it is in the foreground again

// A signal handler can reach nothing but a global; these are written before it is installed.
termios before{};
std::atomic<bool> is_changed{false};
std::atomic<bool> is_ending{false};  // the program was told to
struct sigaction interrupt_before {};
struct sigaction terminate_before {};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch these");

/// What ends or suspends a program that does nothing about it.
constexpr std::array<int, 8> kPassedOn{SIGHUP, SIGQUIT, SIGABRT, SIGSEGV,
                                       SIGBUS, SIGFPE,  SIGILL,  SIGTSTP};

/// A terminal that is not ours to control (ENOTTY) has no job control: nobody suspends us for it.
bool is_in_foreground() {
  const pid_t group = tcgetpgrp(STDIN_FILENO);
  return group == getpgrp() || (group < 0 && errno == ENOTTY);
}

void restore() {
  if (is_changed.exchange(false) && is_in_foreground()) tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

void take() {
  termios single = before;
  single.c_lflag &= ~tcflag_t(ICANON | ECHO);
  single.c_iflag &= ~tcflag_t(IXON);  // Ctrl-S would hold up whoever prints, the loop too
  single.c_cc[VMIN] = 1;
  single.c_cc[VTIME] = 0;
  if (tcsetattr(STDIN_FILENO, TCSANOW, &single) == 0) is_changed = true;
}

using Handler = void (*)(int);

Handler handler_of(int signal) {
  struct sigaction now {};
  sigaction(signal, nullptr, &now);
  return now.sa_handler;
}

void install(int signal, Handler handler, struct sigaction* old) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_NODEFER;  // it is raised again from within
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, old);
}

/// Ends, or suspends, the program as if there were no handler.
void pass_on(int signal) {
  const int kept = errno;
  restore();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  if (signal == SIGTSTP) install(SIGTSTP, pass_on, nullptr);  // and here it goes on
  errno = kept;
}

/// Ctrl-C and SIGTERM finish the run, and a second one kills it: the terminal is given back at the
/// first.
void end(int signal) {
  const int kept = errno;
  is_ending = true;
  restore();
  struct sigaction& was = signal == SIGINT ? interrupt_before : terminate_before;
  sigaction(signal, &was, nullptr);
  std::raise(signal);
  errno = kept;
}

void install_all() {
  install(SIGINT, end, &interrupt_before);
  install(SIGTERM, end, &terminate_before);
  for (const int signal : kPassedOn) {
    if (handler_of(signal) != SIG_IGN) install(signal, pass_on, nullptr);
  }
}

void remove_all() {
  for (const int signal : kPassedOn) {
    if (handler_of(signal) == pass_on) std::signal(signal, SIG_DFL);
  }
  if (handler_of(SIGINT) == end) sigaction(SIGINT, &interrupt_before, nullptr);
  if (handler_of(SIGTERM) == end) sigaction(SIGTERM, &terminate_before, nullptr);
}

/// Blocks all signals in the thread that lives on while this does: they are for the others, and a
/// read or a setting from the background fails instead of suspending the program.
class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~NoSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_{};
};

/// What was typed; empty when nothing is there.
std::string typed() {
  std::array<char, 64> keys{};
  const ssize_t count = ::read(STDIN_FILENO, keys.data(), keys.size());
  return count <= 0 ? std::string() : std::string(keys.data(), std::size_t(count));
}

/// Whether somebody has set the terminal back, as a shell does with a program it was not told of.
bool is_cooked() {
  termios now{};
  return tcgetattr(STDIN_FILENO, &now) == 0 && (now.c_lflag & (ICANON | ECHO)) != 0;
}

}  // namespace

bool TerminalKeys::is_there() { return isatty(STDIN_FILENO) == 1; }

TerminalKeys::TerminalKeys(std::function<void(const std::string&)> on_key)
    : on_key_(std::move(on_key)) {
  is_ending = false;
  if (!is_there() || tcgetattr(STDIN_FILENO, &before) != 0) return;
  wake_ = eventfd(0, EFD_CLOEXEC);
  if (wake_ < 0) throw std::runtime_error("terminal: no event descriptor to be had");
  install_all();
  const NoSignals none;
  thread_ = std::thread([this] { run(); });
}

TerminalKeys::~TerminalKeys() {
  if (!thread_.joinable()) return;
  const std::uint64_t one = 1;
  // An eventfd takes a first word always (eventfd(2)).
  [[maybe_unused]] const ssize_t written = ::write(wake_, &one, sizeof one);
  thread_.join();
  ::close(wake_);
  restore();
  remove_all();
}

void TerminalKeys::run() {
  while (true) {
    const bool ours = is_in_foreground();
    if (!ours) is_changed = false;  // what it is now is the other's
    if (ours && !is_ending && (!is_changed || is_cooked())) take();
    if (is_ending) restore();
    const bool listens = ours && is_changed;
    std::array<pollfd, 2> waits{{{wake_, POLLIN, 0}, {listens ? STDIN_FILENO : -1, POLLIN, 0}}};
    ::poll(waits.data(), waits.size(), kLook_ms);
    if (waits[0].revents != 0) return;
    if ((waits[1].revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) return;
    if (!ours || (waits[1].revents & POLLIN) == 0) continue;
    const std::string keys = typed();
    if (!keys.empty()) {
      on_key_(keys);
    } else {
      ::poll(waits.data(), 1, kLook_ms);  // an end of a line, or of a file, is not one of the keys
    }
  }
}

}  // namespace kestrel::app
