#pragma once

#include <atomic>
#include <string>
#include <thread>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "cli/bound_socket.hpp"

namespace kestrel::test {

/// The page of a camera that shows MJPEG: what a sender pushes into a TCP port as a multipart body
/// goes on over HTTP to one viewer at a time, the latest one, until the sender ends. GStreamer
/// makes the body (multipartmux ! tcpclientsink), but is no HTTP server.
class MjpegPage {
 public:
  /// `boundary` is what the sender puts between its pictures.
  MjpegPage(int port, int feed_port, const std::string& boundary)
      : listener_(listening_socket(port)), feed_listener_(listening_socket(feed_port)) {
    header_ = "HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace;boundary=" + boundary +
              "\r\n\r\n";
    thread_ = std::thread([this] { serve(); });
  }
  ~MjpegPage() {
    stop_ = true;
    thread_.join();
    for (const int socket : {listener_, feed_listener_, viewer_, feed_})
      if (socket >= 0) close(socket);
  }
  MjpegPage(const MjpegPage&) = delete;
  MjpegPage& operator=(const MjpegPage&) = delete;

 private:
  void serve() {
    while (!stop_) {
      pollfd sockets[] = {{listener_, POLLIN, 0}, {feed_listener_, POLLIN, 0}, {feed_, POLLIN, 0}};
      poll(sockets, 3, 20);
      if (sockets[2].revents != 0) forward();
      if ((sockets[0].revents & POLLIN) != 0) greet();
      if ((sockets[1].revents & POLLIN) != 0) {
        leave(feed_);
        feed_ = accept(feed_listener_, nullptr, nullptr);
      }
    }
  }

  static void leave(int& socket) {
    if (socket >= 0) close(socket);
    socket = -1;
  }

  void greet() {
    leave(viewer_);
    viewer_ = accept(listener_, nullptr, nullptr);
    char request[4096];
    if (recv(viewer_, request, sizeof request, 0) <= 0) return leave(viewer_);
    send_all(header_.data(), header_.size());
  }

  void forward() {
    char bytes[65536];
    const auto n = recv(feed_, bytes, sizeof bytes, 0);
    if (n > 0) return send_all(bytes, std::size_t(n));
    leave(feed_);
    leave(viewer_);
  }

  void send_all(const char* bytes, std::size_t count) {
    for (std::size_t sent = 0; sent < count && viewer_ >= 0;) {
      const auto n = send(viewer_, bytes + sent, count - sent, MSG_NOSIGNAL);
      if (n <= 0) return leave(viewer_);
      sent += std::size_t(n);
    }
  }

  int listener_;
  int feed_listener_;
  int viewer_ = -1;
  int feed_ = -1;
  std::string header_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace kestrel::test
