#include "cli/program.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kestrel::test {
namespace {

void redirect(int descriptor, const char* file, int flags) {
  const int opened = open(file, flags, 0600);
  if (opened < 0) _exit(126);
  dup2(opened, descriptor);
  close(opened);
}

/// "NAME=value" into the environment.
void set(const std::string& setting) {
  const auto equals = setting.find('=');
  setenv(setting.substr(0, equals).c_str(), setting.substr(equals + 1).c_str(), 1);
}

Command kestrel_command(const std::vector<std::string>& arguments) {
  Command command{{KESTREL_PROGRAM}};
  command.words.insert(command.words.end(), arguments.begin(), arguments.end());
  return command;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 const std::vector<std::string>& environment)
    : Program(kestrel_command(arguments), folder, environment) {}

Program::Program(const Command& command, const std::filesystem::path& folder,
                 const std::vector<std::string>& environment) {
  static std::atomic<int> count{0};
  const std::string stem = "program-" + std::to_string(getpid()) + "-" + std::to_string(++count);
  out_ = std::filesystem::temp_directory_path() / (stem + ".out");
  err_ = std::filesystem::temp_directory_path() / (stem + ".err");
  std::vector<std::string> words = command.words;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string out = out_.string();
  const std::string err = err_.string();
  const std::string where = folder.string();
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) {
    redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
    redirect(STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
    redirect(STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
    if (chdir(where.c_str()) != 0) _exit(126);
    for (const std::string& setting : environment) set(setting);
    execvp(argv[0], argv.data());
    _exit(127);
  }
}

Program::~Program() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  std::error_code ignored;
  std::filesystem::remove(out_, ignored);
  std::filesystem::remove(err_, ignored);
}

void Program::signal(int number) const { kill(pid_, number); }

Outcome Program::wait(double timeout_s) {
  const auto start = std::chrono::steady_clock::now();
  int status = 0;
  rusage usage{};
  while (wait4(pid_, &status, WNOHANG, &usage) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    if (waited.count() > timeout_s) kill(pid_, SIGKILL);
  }
  pid_ = -1;
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.peak_memory_bytes = double(usage.ru_maxrss) * 1024;  // Linux counts kilobytes
  outcome.out = read(out_);
  outcome.err = read(err_);
  return outcome;
}

Outcome kestrel(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  return Program(arguments, folder).wait();
}

std::string read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace kestrel::test
