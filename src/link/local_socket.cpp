#include "local_socket.hpp"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include <sys/socket.h>
#include <sys/stat.h>
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

/// Removes the socket of a program that is gone.
void make_room(const std::filesystem::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return;
  if (!S_ISSOCK(found.st_mode)) {
    throw std::runtime_error(path.string() + ": is there and is no socket; give another path");
  }
  const int probe = local_socket(path, SOCK_NONBLOCK);
  const bool answered = connect_locally(probe, path);
  const int reason = errno;
  ::close(probe);
  if (answered || reason != ECONNREFUSED) {
    throw std::runtime_error(path.string() + ": another program listens there; give another path");
  }
  ::unlink(path.c_str());
}

}  // namespace

int local_socket(const std::filesystem::path& path, int more) {
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | more, 0);
  if (descriptor < 0) fail_at(path.string(), "cannot open a socket");
  return descriptor;
}

bool connect_locally(int descriptor, const std::filesystem::path& path) {
  const sockaddr_un name = local_name(path);
  return ::connect(descriptor, reinterpret_cast<const sockaddr*>(&name), sizeof name) == 0;
}

int listen_locally(const std::filesystem::path& path, int waiting) {
  const sockaddr_un name = local_name(path);
  make_room(path);
  const int descriptor = local_socket(path, SOCK_NONBLOCK);
  // The mode of the socket becomes that of the file: there is no moment when others may connect.
  if (::fchmod(descriptor, S_IRUSR | S_IWUSR) != 0 ||
      ::bind(descriptor, reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0 ||
      ::listen(descriptor, waiting) != 0) {
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    fail_at(path.string(), "cannot listen");
  }
  return descriptor;
}

}  // namespace kestrel
