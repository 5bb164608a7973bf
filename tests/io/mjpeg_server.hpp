#pragma once

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <opencv2/imgcodecs.hpp>

namespace kestrel::test {

/// A camera that sends MJPEG over HTTP on the loopback, to one viewer: frame k is all of grey value
/// (k % 20) * 10. After `frames` frames it stalls (keeps the connection and sends nothing), ends
/// (closes it) or spoils them (sends parts that are no JPEG).
class MjpegServer {
 public:
  enum class Then { Stall, End, Spoil };

  MjpegServer(int frames, Then then) : listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        listen(listener_, 4) != 0 ||
        getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
      throw std::runtime_error("no port on the loopback");
    }
    url_ = "http://127.0.0.1:" + std::to_string(ntohs(address.sin_port)) + "/video";
    thread_ = std::thread([this, frames, then] { serve(frames, then); });
  }
  ~MjpegServer() {
    stop_ = true;
    thread_.join();
    close(listener_);
  }
  MjpegServer(const MjpegServer&) = delete;
  MjpegServer& operator=(const MjpegServer&) = delete;

  const std::string& url() const { return url_; }

 private:
  void serve(int frames, Then then) {
    pollfd waiting{listener_, POLLIN, 0};
    while (poll(&waiting, 1, 10) == 0) {
      if (stop_) return;
    }
    const int viewer = accept(listener_, nullptr, nullptr);
    char request[4096];
    if (recv(viewer, request, sizeof request, 0) > 0 &&
        write_all(viewer,
                  "HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace;boundary=frame\r\n"
                  "\r\n")) {
      for (int k = 0; k < frames && !stop_ && write_all(viewer, part(k)); ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    }
    while (then != Then::End && !stop_) {
      if (then == Then::Spoil && !write_all(viewer, spoiled())) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    close(viewer);
  }

  static std::string part(int k) {
    std::vector<uchar> jpeg;
    cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar::all((k % 20) * 10)), jpeg);
    return "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) +
           "\r\n\r\n" + std::string(jpeg.begin(), jpeg.end()) + "\r\n";
  }

  /// A part whose JPEG begins as one and goes on with what is none.
  static std::string spoiled() {
    const std::string jpeg = "\xff\xd8\xff\xdb" + std::string(2000, 'x') + "\xff\xd9";
    return "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) +
           "\r\n\r\n" + jpeg + "\r\n";
  }

  static bool write_all(int socket, const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const auto n = send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return false;
      sent += std::size_t(n);
    }
    return true;
  }

  int listener_;
  std::string url_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace kestrel::test
