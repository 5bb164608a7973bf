#pragma once

#include <array>
#include <string>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace kestrel::test {

/// A connection to a port of this machine, for what no well-behaved client sends.
class RawConnection {
 public:
  explicit RawConnection(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const auto* any = reinterpret_cast<const sockaddr*>(&to);
    is_open_ = ::connect(socket_, any, sizeof to) == 0;
  }
  ~RawConnection() { ::close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  /// False once the other end is closed.
  bool send(const std::string& text) {
    is_open_ =
        is_open_ && ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == ssize_t(text.size());
    return is_open_;
  }

  /// All that comes until the other end closes, or nothing comes for so long.
  std::string rest(double silence_s) {
    std::string all;
    std::array<char, 4096> some{};
    pollfd one{socket_, POLLIN, 0};
    while (::poll(&one, 1, int(silence_s * 1e3)) > 0) {
      const ssize_t count = ::recv(socket_, some.data(), some.size(), 0);
      if (count <= 0) {
        is_open_ = false;
        break;
      }
      all.append(some.data(), std::size_t(count));
    }
    return all;
  }

  bool is_open() const { return is_open_; }

 private:
  int socket_;
  bool is_open_ = false;
};

}  // namespace kestrel::test
