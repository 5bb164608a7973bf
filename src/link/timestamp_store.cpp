#include "kestrel/link/timestamp_store.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string>
#include <utility>

#include <sys/file.h>
#include <sys/stat.h>

#include "disk_file.hpp"

namespace kestrel::mavlink {
namespace {

using std::filesystem::path;

constexpr mode_t kOwnerOnly = S_IRUSR | S_IWUSR;
constexpr auto kReserve = std::uint64_t(TimestampStore::kReserve_s * kSigningUnits_per_s);
constexpr auto kReserveAhead = std::uint64_t(TimestampStore::kReserveAhead_s * kSigningUnits_per_s);

path beside(const path& file, const char* ending) { return path(file).concat(ending); }

/// The time in the file: decimal digits and a newline.
std::uint64_t stored_time(const path& file) {
  const disk::OpenFile opened(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!opened.is_open()) {
    if (errno == ENOENT) return 0;
    disk::fail(file, "cannot be opened: " + disk::reason());
  }
  std::array<char, 32> text{};
  const ssize_t size = disk::read_up_to(opened, text.data(), text.size());
  std::uint64_t time = 0;
  if (size > 1) {
    const char* newline = text.data() + size - 1;
    const auto [end, error] = std::from_chars(text.data(), newline, time);
    if (error == std::errc() && end == newline && *newline == '\n' && time <= kLastSigningTime) {
      return time;
    }
  }
  disk::fail(file,
             "holds no signing time; if it cannot be brought back, give the link a new key "
             "and remove the file (with the old key, old frames could be sent again)");
}

bool store(const path& file, std::uint64_t time) {
  const path fresh = beside(file, ".new");
  const int flags = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC;
  const disk::OpenFile opened(::open(fresh.c_str(), flags, kOwnerOnly));
  return opened.is_open() && disk::write_through(opened, std::to_string(time) + "\n") &&
         ::rename(fresh.c_str(), file.c_str()) == 0 && disk::sync_folder_of(file);
}

}  // namespace

/// Held as long as it lives, by one process at a time; the kernel lets go of it for a dead one.
class TimestampStore::Lock {
 public:
  explicit Lock(const path& file)
      : opened_(::open(beside(file, ".lock").c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC,
                       kOwnerOnly)) {
    if (!opened_.is_open()) {
      disk::fail(beside(file, ".lock"), "cannot be made: " + disk::reason() +
                                            "; name a file in a folder that can be written");
    }
    if (::flock(opened_.get(), LOCK_EX | LOCK_NB) != 0) {
      disk::fail(file,
                 "another process signs with these times; end it, or give this one a file "
                 "and a link_id of its own");
    }
  }

 private:
  disk::OpenFile opened_;
};

TimestampStore::TimestampStore(path file)
    : file_(std::move(file)), lock_(std::make_unique<Lock>(file_)) {
  last_ = stored_time(file_);
  reserved_ = last_.load();
}

TimestampStore::~TimestampStore() = default;

std::uint64_t TimestampStore::next_at(std::uint64_t now) const {
  return std::max(last_.load() + 1, now);
}

std::optional<std::uint64_t> TimestampStore::next(double unix_s) {
  const std::uint64_t time = next_at(signing_time(unix_s));
  if (time > kLastSigningTime) return std::nullopt;
  if (time > reserved_ && !extend(unix_s)) return std::nullopt;
  last_ = time;
  return time;
}

bool TimestampStore::is_low(double unix_s) const {
  const std::uint64_t now = signing_time(unix_s);
  const std::uint64_t time = next_at(now);
  const std::uint64_t reserve = time > now ? kReserveAhead : kReserve;
  return time + reserve / 2 > reserved_;
}

bool TimestampStore::extend(double unix_s) {
  const std::lock_guard<std::mutex> guard(writing_);
  const std::uint64_t now = signing_time(unix_s);
  const std::uint64_t time = next_at(now);
  const std::uint64_t until =
      std::min(time + (time > now ? kReserveAhead : kReserve), kLastSigningTime);
  if (until <= reserved_) return true;
  if (!store(file_, until)) return false;
  reserved_ = until;
  return true;
}

double TimestampStore::ahead_s(double unix_s) const {
  const std::uint64_t now = signing_time(unix_s);
  return double(next_at(now) - now) / kSigningUnits_per_s;
}

}  // namespace kestrel::mavlink
