#pragma once

#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "cli/program.hpp"

namespace kestrel::test {

/// A port of loopback that was free a moment ago, for both UDP and TCP; even, as RTP wants it.
inline int free_port() {
  for (int tries = 0; tries < 100; ++tries) {
    const int udp = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    bind(udp, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(udp, reinterpret_cast<sockaddr*>(&address), &size);
    close(udp);
    if (ntohs(address.sin_port) % 2 == 0) return ntohs(address.sin_port);
  }
  return 45678;
}

/// What FFmpeg shows, and over what.
struct VideoStream {
  std::vector<std::string> input;   // options of FFmpeg's input, -i with them
  std::vector<std::string> output;  // codec, container and address
};

/// FFmpeg, sending in real time.
inline Command ffmpeg_command(const VideoStream& stream) {
  Command c{{"ffmpeg", "-nostdin", "-loglevel", "error", "-re"}};
  c.words.insert(c.words.end(), stream.input.begin(), stream.input.end());
  c.words.insert(c.words.end(), {"-an", "-threads", "1"});
  c.words.insert(c.words.end(), stream.output.begin(), stream.output.end());
  return c;
}

/// A program as a camera that sends; killed at the end of its life.
class VideoSender {
 public:
  VideoSender(const Command& command, const std::filesystem::path& folder)
      : program_(command, folder) {}
  VideoSender(const VideoStream& stream, const std::filesystem::path& folder)
      : VideoSender(ffmpeg_command(stream), folder) {}
  /// The process stands still: its connections stay open and nothing comes.
  void stall() const { program_.signal(SIGSTOP); }
  void go_on() const { program_.signal(SIGCONT); }

 private:
  Program program_;
};

/// FFmpeg's own test picture, moving, 25 pictures per second.
inline std::vector<std::string> test_picture(int width, int height) {
  return {"-f", "lavfi", "-i",
          "testsrc2=size=" + std::to_string(width) + "x" + std::to_string(height) + ":rate=25"};
}

/// MPEG-TS over UDP.
inline std::vector<std::string> mpeg_over_udp(int port) {
  return {"-c:v",
          "mpeg2video",
          "-q:v",
          "2",
          "-g",
          "5",
          "-bf",
          "0",
          "-f",
          "mpegts",
          "udp://127.0.0.1:" + std::to_string(port) + "?pkt_size=1316"};
}

}  // namespace kestrel::test
