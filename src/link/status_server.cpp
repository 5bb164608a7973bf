#include "kestrel/link/status_server.hpp"

#include <array>

#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "local_socket.hpp"
#include "owned_descriptor.hpp"
#include "socket_address.hpp"

namespace kestrel {
StatusServer::StatusServer(const std::filesystem::path& path) : path_(path) {
  constexpr int kWaiting = 4;
  descriptor_ = listen_locally(path, kWaiting);
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
  ::setsockopt(asker.number(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(asker.number(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  if (!connect_locally(asker.number(), path)) fail_at(path.string(), "no switch answers");
  std::string text;
  std::array<char, 4096> piece;
  for (;;) {
    const ssize_t size = ::recv(asker.number(), piece.data(), piece.size(), 0);
    if (size < 0) fail_at(path.string(), "no switch answers");
    if (size == 0) return text;
    text.append(piece.data(), std::size_t(size));
  }
}

}  // namespace kestrel
