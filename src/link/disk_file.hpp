#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

// Small files whose owner, mode and way to the disk matter, so that streams do not do.
namespace kestrel::disk {

/// An open file descriptor, or none (-1).
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int get() const { return descriptor_; }
  bool is_open() const { return descriptor_ >= 0; }

 private:
  int descriptor_;
};

[[noreturn]] inline void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

/// What the last system call that failed said.
inline std::string reason() { return std::strerror(errno); }

/// Writes it all, and waits for it to be on the disk.
inline bool write_through(const OpenFile& file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file.get(), text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(std::size_t(written));
  }
  return ::fsync(file.get()) == 0;
}

/// Waits for the names in a file's folder to be on the disk.
inline bool sync_folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const OpenFile opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.is_open() && ::fsync(opened.get()) == 0;
}

/// Reads up to `size` bytes; fewer only at the end of the file. -1 when it cannot.
inline ssize_t read_up_to(const OpenFile& file, char* to, std::size_t size) {
  std::size_t count = 0;
  while (count < size) {
    const ssize_t got = ::read(file.get(), to + count, size - count);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    count += std::size_t(got);
  }
  return ssize_t(count);
}

}  // namespace kestrel::disk
