#include "kestrel/link/key_file.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include <sodium.h>
#include <sys/stat.h>

#include "disk_file.hpp"

namespace kestrel::mavlink {
namespace {

using std::filesystem::path;

constexpr std::size_t kDigits = 2 * SigningKey::kSize;
constexpr mode_t kPermissions = 07777;
constexpr mode_t kOwnerOnly = S_IRUSR | S_IWUSR;

/// Bytes that are wiped where they end.
template <std::size_t N>
struct Wiped {
  std::array<char, N> data{};
  Wiped() = default;
  ~Wiped() { sodium_memzero(data.data(), data.size()); }
  Wiped(const Wiped&) = delete;
  Wiped& operator=(const Wiped&) = delete;
};

[[noreturn]] void fail_to_open(const path& file) {
  switch (errno) {
    case ENOENT:
      disk::fail(file, "there is no such key file; make one with: kestrel key " + file.string());
    case ELOOP:
      disk::fail(file, "is a symbolic link; name the key file itself");
    default:
      disk::fail(file, "cannot be opened: " + disk::reason() + "; run as the owner of the key");
  }
}

void check_is_private(const path& file, const disk::OpenFile& opened) {
  struct stat status {};
  if (::fstat(opened.get(), &status) != 0) disk::fail(file, disk::reason());
  if (!S_ISREG(status.st_mode)) disk::fail(file, "is no regular file; name the key file itself");
  if (status.st_uid != ::geteuid()) {
    disk::fail(file,
               "belongs to another user; run as its owner, or make a key of your own with: "
               "kestrel key");
  }
  const mode_t mode = status.st_mode & kPermissions;
  if (mode == kOwnerOnly) return;
  std::array<char, 8> octal{};
  std::snprintf(octal.data(), octal.size(), "%04o", unsigned(mode));
  disk::fail(file, std::string("has mode ") + octal.data() +
                       ", but a key is for its owner only; run: chmod 600 " + file.string());
}

[[noreturn]] void fail_to_read(const path& file) {
  disk::fail(file,
             "holds no key (64 hexadecimal digits, not all of them 0, and a newline); "
             "make a new one with: kestrel key");
}

}  // namespace

SigningKey load_key(const path& file) {
  // Not blocking, lest a pipe of that name holds the program up.
  const int flags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  const disk::OpenFile opened(::open(file.c_str(), flags));
  if (!opened.is_open()) fail_to_open(file);
  check_is_private(file, opened);
  Wiped<kDigits + 2> text;
  const ssize_t size = disk::read_up_to(opened, text.data.data(), text.data.size());
  if (size != ssize_t(kDigits + 1) || text.data[kDigits] != '\n') fail_to_read(file);
  Wiped<SigningKey::kSize> bytes;
  std::size_t count = 0;
  auto* to = reinterpret_cast<unsigned char*>(bytes.data.data());
  sodium_hex2bin(to, bytes.data.size(), text.data.data(), kDigits, nullptr, &count, nullptr);
  // To autopilots a key of zeros means that signing is off (mavlink.io, SETUP_SIGNING).
  if (count != SigningKey::kSize || sodium_is_zero(to, count) == 1) fail_to_read(file);
  SigningKey::Secret secret{};
  std::copy_n(to, count, secret.begin());
  const SigningKey key(secret);
  sodium_memzero(secret.data(), secret.size());
  return key;
}

void write_key(const path& file, const SigningKey& key) {
  const int flags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  const disk::OpenFile opened(::open(file.c_str(), flags, kOwnerOnly));
  if (!opened.is_open()) {
    if (errno == EEXIST) {
      disk::fail(file, "is there already; a key is never overwritten: choose another name");
    }
    disk::fail(file, "cannot be written: " + disk::reason());
  }
  Wiped<kDigits + 1> text;
  sodium_bin2hex(text.data.data(), text.data.size(), key.bytes().data, SigningKey::kSize);
  text.data[kDigits] = '\n';
  const bool written = ::fchmod(opened.get(), kOwnerOnly) == 0 &&
                       disk::write_through(opened, {text.data.data(), text.data.size()}) &&
                       disk::sync_folder_of(file);
  if (written) return;
  const std::string reason = disk::reason();
  ::unlink(file.c_str());
  disk::fail(file, "cannot be written: " + reason);
}

}  // namespace kestrel::mavlink
