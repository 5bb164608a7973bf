#include "kestrel/io/run_folder.hpp"

#include <stdexcept>
#include <string>
#include <system_error>

namespace kestrel {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& cause) {
  throw std::runtime_error(path.string() + ": cannot create the run folder: " + cause +
                           "; choose a folder that can be written");
}

// True when this call created the folder, false when it was there: mkdir decides, so two programs
// never get the same one.
bool created(const fs::path& path) {
  std::error_code error;
  if (fs::create_directory(path, error)) return true;
  if (error && error != std::errc::file_exists) fail(path, error.message());
  return false;
}

}  // namespace

fs::path create_run_folder(const fs::path& wanted) {
  if (wanted.empty()) fail(wanted, "its name is empty");
  const fs::path path = wanted.has_filename() ? wanted : wanted.parent_path();  // "runs/a/"
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) fail(path, error.message());
  constexpr int kMost = 100000;
  for (int number = 1; number <= kMost; ++number) {
    fs::path candidate = path;
    if (number > 1) candidate += "-" + std::to_string(number);
    if (created(candidate)) return candidate;
  }
  fail(path, "all its numbers are taken");
}

}  // namespace kestrel
