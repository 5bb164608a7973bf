#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kestrel::test {

/// What a finished program left.
struct Outcome {
  int exit_code = -1;  // 128 + signal when one ended it
  std::string out;
  std::string err;
  /// The most that was resident; never less than what the test itself had when it started it.
  double peak_memory_bytes = 0;
};

/// Any other program and its arguments; found as a shell finds it.
struct Command {
  std::vector<std::string> words;
};

/// The program under test, running.
class Program {
 public:
  Program(const Command& command, const std::filesystem::path& folder,
          const std::vector<std::string>& environment = {});
  /// Starts kestrel with these arguments, stdin empty, in a folder; environment is added to ours.
  Program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
          const std::vector<std::string>& environment = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const;
  /// Waits for the end, at most timeout_s (then it is killed).
  Outcome wait(double timeout_s = 60);

 private:
  int pid_ = -1;
  std::filesystem::path out_;
  std::filesystem::path err_;
};

/// Starts kestrel and waits for its end.
Outcome kestrel(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// The bytes of a file; none when it cannot be read.
std::string read(const std::filesystem::path& file);

}  // namespace kestrel::test

/// Expects the text to have this part, and shows the text when it has not.
#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)
