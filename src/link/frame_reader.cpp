#include "kestrel/link/frame_reader.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <utility>

#include <poll.h>
#include <sys/socket.h>

#include "kestrel/link/autopilot_link.hpp"

#include "frame_socket.hpp"

namespace kestrel {
namespace {

constexpr double kRetry_s = 0.2;
constexpr double kConnect_s = 1;
constexpr double kStall_s = 2;  // within a frame
constexpr int kLook_ms = 50;    // how often it is looked whether to stop
constexpr std::size_t kMaxProblems = 100;

}  // namespace

FrameReader::FrameReader(const FramePlace& from) : from_(from) {
  thread_ = std::thread([this] { run(); });
}

FrameReader::~FrameReader() {
  stop_ = true;
  changed_.notify_all();
  thread_.join();
}

std::optional<ReceivedFrame> FrameReader::next(double timeout_s) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                    [this] { return newest_.has_value(); });
  std::optional<ReceivedFrame> frame;
  frame.swap(newest_);
  return frame;
}

std::vector<std::string> FrameReader::take_problems() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(problems_, {});
}

std::string FrameReader::last_problem() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_problem_;
}

FrameReaderCounts FrameReader::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

void FrameReader::note(const std::string& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (problem == last_problem_) return;
  last_problem_ = problem;
  if (problems_.size() < kMaxProblems) problems_.push_back(problem);
}

void FrameReader::keep(ReceivedFrame frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.received;
  counts_.replaced += newest_ ? 1 : 0;
  frame.connection = counts_.connections;
  newest_ = std::move(frame);
  changed_.notify_one();
}

void FrameReader::run() noexcept {
  while (!stop_) {
    bool connected = false;
    try {
      const OwnedDescriptor socket = connect_for_frames(from_, kConnect_s);
      connected = true;
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        ++counts_.connections;
      }
      read_stream(socket.number());
    } catch (const std::exception& error) {
      note(error.what());
      const std::lock_guard<std::mutex> lock(mutex_);
      counts_.broken += connected ? 1 : 0;
    }
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, std::chrono::duration<double>(kRetry_s),
                      [this] { return bool(stop_); });
  }
}

void FrameReader::read_stream(int descriptor) {
  FrameClock clock;
  std::array<std::uint8_t, kFrameHeaderBytes> head{};
  while (read(descriptor, head.data(), 1, "")) {
    if (!read(descriptor, head.data() + 1, head.size() - 1, "the header of a frame")) return;
    const double arrived_s = link_clock_s();
    const auto decoded = decode_frame_header({head.data(), head.size()});
    if (const auto* wrong = std::get_if<std::string>(&decoded)) {
      throw std::runtime_error(to_string(from_) + ": " + *wrong);
    }
    ReceivedFrame frame;
    frame.header = std::get<FrameHeader>(decoded);
    frame.pixels.resize(frame.header.pixels());
    const std::string what = "frame " + std::to_string(frame.header.number);
    if (!read(descriptor, frame.pixels.data(), frame.pixels.size(), what)) return;
    clock.learn(frame.header.sent_s, arrived_s);
    frame.capture_s = *clock.ours(frame.header.capture_s);
    keep(std::move(frame));
  }
}

/// All of `size` bytes; false when it is to stop, or, before anything was begun, the stream has
/// ended. Within something (`what`) the end of the stream, and standing still, throw.
bool FrameReader::read(int descriptor, std::uint8_t* to, std::size_t size,
                       const std::string& what) {
  double heard_s = link_clock_s();
  for (std::size_t got = 0; got < size;) {
    pollfd wanted{descriptor, POLLIN, 0};
    const int ready = ::poll(&wanted, 1, kLook_ms);
    if (stop_) return false;
    const auto within = [&](const char* happened) {
      return std::runtime_error(to_string(from_) + ": " + happened + " within " + what + " (" +
                                std::to_string(got) + " of " + std::to_string(size) + " bytes)");
    };
    if (ready <= 0) {
      if (!what.empty() && link_clock_s() - heard_s > kStall_s) throw within("nothing more came");
      continue;
    }
    const ssize_t count = ::recv(descriptor, to + got, size - got, MSG_DONTWAIT);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) {
      if (what.empty()) {
        note(to_string(from_) + ": the stream of frames ended");
        return false;
      }
      throw within("the stream ended");
    }
    got += std::size_t(count);
    heard_s = link_clock_s();
  }
  return true;
}

}  // namespace kestrel
