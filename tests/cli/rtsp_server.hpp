#pragma once

#include <atomic>
#include <string>
#include <thread>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "cli/bound_socket.hpp"

namespace kestrel::test {

/// A camera that speaks RTSP (RFC 2326) on the loopback, to one viewer at a time, the latest one:
/// what FFmpeg sends to a UDP port as MPEG-TS goes on to it as RTP (RFC 2250, payload type 33)
/// inside the RTSP connection. Debian's FFmpeg is no RTSP server.
class RtspServer {
 public:
  RtspServer(int port, int feed_port)
      : listener_(listening_socket(port)), feed_(bound_socket(SOCK_DGRAM, feed_port)) {
    thread_ = std::thread([this] { serve(); });
  }
  ~RtspServer() {
    stop_ = true;
    thread_.join();
    for (const int socket : {listener_, feed_, viewer_})
      if (socket >= 0) close(socket);
  }
  RtspServer(const RtspServer&) = delete;
  RtspServer& operator=(const RtspServer&) = delete;

 private:
  void serve() {
    while (!stop_) {
      pollfd sockets[] = {{listener_, POLLIN, 0}, {viewer_, POLLIN, 0}, {feed_, POLLIN, 0}};
      poll(sockets, 3, 20);
      if (sockets[1].revents != 0) hear();
      if ((sockets[2].revents & POLLIN) != 0) forward();
      if ((sockets[0].revents & POLLIN) != 0) {
        leave();
        viewer_ = accept(listener_, nullptr, nullptr);
      }
    }
  }

  void leave() {
    if (viewer_ >= 0) close(viewer_);
    viewer_ = -1;
    is_playing_ = false;
    heard_.clear();
  }

  void hear() {
    char bytes[4096];
    const auto n = recv(viewer_, bytes, sizeof bytes, 0);
    if (n <= 0) return leave();
    heard_.append(bytes, std::size_t(n));
    while (drop_report() || answer_request()) {
    }
  }

  /// Takes one of the viewer's RTCP reports out of what was heard.
  bool drop_report() {
    if (heard_.size() < 4 || heard_[0] != '$') return false;
    const auto high = static_cast<unsigned char>(heard_[2]);
    const auto low = static_cast<unsigned char>(heard_[3]);
    const std::size_t size = 4 + 256u * high + low;
    if (heard_.size() < size) return false;
    heard_.erase(0, size);
    return true;
  }

  bool answer_request() {
    const std::size_t end = heard_.find("\r\n\r\n");
    if (heard_.empty() || heard_[0] == '$' || end == std::string::npos) return false;
    const std::string request = heard_.substr(0, end + 2);
    heard_.erase(0, end + 4);
    const std::size_t at = request.find("CSeq:");
    const std::string number = request.substr(at, request.find("\r\n", at) - at);
    send_all("RTSP/1.0 200 OK\r\n" + number + "\r\n" + more(request.substr(0, request.find(' '))));
    if (request.rfind("PLAY", 0) == 0) is_playing_ = true;
    return true;
  }

  /// What an answer says besides that all is well.
  static std::string more(const std::string& method) {
    if (method == "OPTIONS") return "Public: OPTIONS, DESCRIBE, SETUP, PLAY, TEARDOWN\r\n\r\n";
    if (method == "SETUP")
      return "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\nSession: 1\r\n\r\n";
    if (method != "DESCRIBE") return "Session: 1\r\n\r\n";
    const std::string sdp =
        "v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=test\r\nc=IN IP4 0.0.0.0\r\nt=0 0\r\n"
        "m=video 0 RTP/AVP 33\r\na=control:track\r\n";
    return "Content-Type: application/sdp\r\nContent-Length: " + std::to_string(sdp.size()) +
           "\r\n\r\n" + sdp;
  }

  /// A datagram of the feed (seven packets of MPEG-TS) as an interleaved RTP packet.
  void forward() {
    char bytes[2048];
    const auto n = recv(feed_, bytes, sizeof bytes, 0);
    if (n <= 0 || !is_playing_) return;
    ++sequence_;
    const std::size_t size = 12 + std::size_t(n);
    std::string packet = {'$', 0, char(size >> 8), char(size & 255)};
    packet += {char(0x80), 33, char(sequence_ >> 8), char(sequence_ & 255)};
    packet.append(7, '\0');  // time stamp and source: MPEG-TS has its own clock
    packet += '\1';
    packet.append(bytes, std::size_t(n));
    send_all(packet);
  }

  void send_all(const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const auto n = send(viewer_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return leave();
      sent += std::size_t(n);
    }
  }

  int listener_;
  int feed_;
  int viewer_ = -1;
  bool is_playing_ = false;
  std::uint16_t sequence_ = 0;
  std::string heard_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace kestrel::test
