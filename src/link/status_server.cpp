#include "kestrel/link/status_server.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include "socket_address.hpp"

namespace kestrel {
namespace {

sockaddr_un local_name(const std::filesystem::path& path) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.empty() || text.size() >= sizeof name.sun_path) {
    throw std::runtime_error(text + ": no path for a socket: at most " +
                             std::to_string(sizeof name.sun_path - 1) + " characters");
  }
  std::memcpy(name.sun_path, text.c_str(), text.size() + 1);
  return name;
}

/// Closed at the end of its scope.
struct OwnedDescriptor {
  int number;
  explicit OwnedDescriptor(int opened) : number(opened) {}
  ~OwnedDescriptor() {
    if (number >= 0) ::close(number);
  }
  OwnedDescriptor(const OwnedDescriptor&) = delete;
  OwnedDescriptor& operator=(const OwnedDescriptor&) = delete;
};

int local_socket(const std::filesystem::path& path, int more) {
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | more, 0);
  if (descriptor < 0) fail_at(path.string(), "cannot open a socket");
  return descriptor;
}

bool connects(int descriptor, const sockaddr_un& name) {
  return ::connect(descriptor, reinterpret_cast<const sockaddr*>(&name), sizeof name) == 0;
}

/// Removes the socket of a program that is gone.
void make_room(const std::filesystem::path& path, const sockaddr_un& name) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return;
  if (!S_ISSOCK(found.st_mode)) {
    throw std::runtime_error(path.string() + ": is there and is no socket; give another path");
  }
  const OwnedDescriptor probe(local_socket(path, SOCK_NONBLOCK));
  if (connects(probe.number, name) || errno != ECONNREFUSED) {
    throw std::runtime_error(path.string() + ": another program listens there; give another path");
  }
  ::unlink(path.c_str());
}

}  // namespace

StatusServer::StatusServer(const std::filesystem::path& path) : path_(path) {
  const sockaddr_un name = local_name(path);
  make_room(path, name);
  constexpr int kWaiting = 4;
  const int descriptor = local_socket(path, SOCK_NONBLOCK);
  // The mode of the socket becomes that of the file: there is no moment when others may connect.
  if (::fchmod(descriptor, S_IRUSR | S_IWUSR) != 0 ||
      ::bind(descriptor, reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0 ||
      ::listen(descriptor, kWaiting) != 0) {
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    fail_at(path.string(), "cannot listen");
  }
  descriptor_ = descriptor;
}

StatusServer::~StatusServer() {
  ::close(descriptor_);
  ::unlink(path_.c_str());
}

int StatusServer::accept_one() noexcept {
  return ::accept4(descriptor_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
}

void StatusServer::give(int asker, const std::string& text) noexcept {
  const OwnedDescriptor owned(asker);
  [[maybe_unused]] const ssize_t taken =
      ::send(asker, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

std::string ask_status(const std::filesystem::path& path, double timeout_s) {
  const OwnedDescriptor asker(local_socket(path, 0));
  const auto whole = static_cast<time_t>(timeout_s);
  const timeval patience{whole, static_cast<suseconds_t>((timeout_s - double(whole)) * 1e6)};
  ::setsockopt(asker.number, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(asker.number, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  if (!connects(asker.number, local_name(path))) fail_at(path.string(), "no switch answers");
  std::string text;
  std::array<char, 4096> piece;
  for (;;) {
    const ssize_t size = ::recv(asker.number, piece.data(), piece.size(), 0);
    if (size < 0) fail_at(path.string(), "no switch answers");
    if (size == 0) return text;
    text.append(piece.data(), std::size_t(size));
  }
}

}  // namespace kestrel
