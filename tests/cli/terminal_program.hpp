#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utmp.h>

namespace kestrel::test {

/// A program at a terminal of its own, as its session's leader; what it prints there is kept.
class TerminalProgram {
 public:
  TerminalProgram(const std::vector<std::string>& words, const std::filesystem::path& folder) {
    if (openpty(&master_, &terminal_, nullptr, nullptr, nullptr) != 0) {
      throw std::runtime_error("no terminal to be had");
    }
    before_ = attributes();
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ == 0) become(words, folder);
    thread_ = std::thread([this] { listen(); });
  }
  ~TerminalProgram() {
    if (pid_ > 0) {
      kill(-pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    done_ = true;
    thread_.join();
    close(terminal_);
    close(master_);
  }
  TerminalProgram(const TerminalProgram&) = delete;
  TerminalProgram& operator=(const TerminalProgram&) = delete;

  void type(const std::string& keys) const {
    if (::write(master_, keys.data(), keys.size()) != ssize_t(keys.size())) {
      throw std::runtime_error("the terminal takes no keys");
    }
  }
  /// To it and all it has started.
  void signal(int number) const { kill(-pid_, number); }
  std::string printed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return printed_;
  }

  termios attributes() const {
    termios now{};
    if (tcgetattr(terminal_, &now) != 0) throw std::runtime_error("no terminal");
    return now;
  }
  /// Whether keys come one by one and are not shown.
  bool is_single() const { return (attributes().c_lflag & tcflag_t(ICANON | ECHO)) == 0; }
  /// Sets the terminal back, as a shell does.
  void cook() const { tcsetattr(master_, TCSANOW, &before_); }
  /// Whether the terminal is as it was before the program.
  bool is_as_before() const {
    const termios now = attributes();
    return now.c_lflag == before_.c_lflag && now.c_iflag == before_.c_iflag &&
           now.c_oflag == before_.c_oflag && now.c_cflag == before_.c_cflag &&
           std::memcmp(now.c_cc, before_.c_cc, sizeof now.c_cc) == 0;
  }
  /// True when it is suspended now; told once.
  bool was_suspended() {
    int status = 0;
    return waitpid(pid_, &status, WNOHANG | WUNTRACED) == pid_ && WIFSTOPPED(status);
  }
  /// Waits for its end: the exit code, or 128 + signal; killed after a minute.
  int wait() {
    int status = 0;
    for (int i = 0; i < 6000 && waitpid(pid_, &status, WNOHANG) == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (kill(pid_, SIGKILL) == 0) waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  [[noreturn]] void become(const std::vector<std::string>& words,
                           const std::filesystem::path& folder) const {
    login_tty(terminal_);  // a session of its own, with this terminal on 0, 1 and 2
    close(master_);
    std::vector<std::string> kept = words;
    std::vector<char*> argv;
    for (std::string& word : kept) argv.push_back(word.data());
    argv.push_back(nullptr);
    if (chdir(folder.c_str()) == 0) execvp(argv[0], argv.data());
    _exit(127);
  }
  void listen() {
    while (!done_) {
      pollfd wait{master_, POLLIN, 0};
      if (poll(&wait, 1, 20) <= 0) continue;
      char text[4096];
      const ssize_t count = ::read(master_, text, sizeof text);
      const std::lock_guard<std::mutex> lock(mutex_);
      if (count > 0) printed_.append(text, std::size_t(count));
    }
  }

  int master_ = -1;
  int terminal_ = -1;
  int pid_ = -1;
  termios before_{};
  std::atomic<bool> done_{false};
  mutable std::mutex mutex_;
  std::string printed_;
  std::thread thread_;
};

}  // namespace kestrel::test
