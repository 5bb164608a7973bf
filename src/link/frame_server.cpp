#include "kestrel/link/frame_server.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <utility>
#include <vector>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include "kestrel/link/autopilot_link.hpp"

#include "frame_socket.hpp"
#include "owned_descriptor.hpp"

namespace kestrel {
namespace {

constexpr int kWaiting = 16;
constexpr double kLongestWait_s = 60;

/// A frame on its way: the header is made when the first byte leaves.
struct Outgoing {
  FrameHeader header;
  std::vector<std::uint8_t> pixels;
};

/// Who reads the frames: the one that is being sent, and the newest that waits.
class Reader {
 public:
  explicit Reader(OwnedDescriptor socket) : socket_(std::move(socket)) {}

  int descriptor() const { return socket_.number(); }
  bool is_gone() const { return gone_; }
  bool has_more() const { return !bytes_.empty(); }

  /// True when a frame that waited was replaced.
  bool put(const FrameHeader& header, Bytes pixels) {
    const bool replaces = !waiting_.pixels.empty();
    waiting_.header = header;
    waiting_.pixels.assign(pixels.begin(), pixels.end());
    return replaces;
  }

  /// Sends as much as the network takes; how many frames are now whole.
  long flush() {
    long whole = 0;
    while (!gone_ && (has_more() || begin())) {
      const ssize_t size = ::send(descriptor(), bytes_.data() + sent_, bytes_.size() - sent_,
                                  MSG_DONTWAIT | MSG_NOSIGNAL);
      if (size < 0) {
        gone_ = errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR;
        return whole;
      }
      sent_ += std::size_t(size);
      if (sent_ < bytes_.size()) continue;
      bytes_.clear();
      ++whole;
    }
    return whole;
  }

  /// Readers say nothing: what there is to hear is that one has left.
  void listen() {
    std::uint8_t byte = 0;
    const ssize_t size = ::recv(descriptor(), &byte, 1, MSG_DONTWAIT);
    if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR)) gone_ = true;
  }

 private:
  bool begin() {
    if (waiting_.pixels.empty()) return false;
    waiting_.header.sent_s = std::max(link_clock_s(), waiting_.header.capture_s);
    const auto header = encode(waiting_.header);
    bytes_.assign(header.begin(), header.end());
    bytes_.insert(bytes_.end(), waiting_.pixels.begin(), waiting_.pixels.end());
    waiting_.pixels.clear();
    sent_ = 0;
    return true;
  }

  OwnedDescriptor socket_;
  std::vector<std::uint8_t> bytes_;  // of the frame that is being sent
  std::size_t sent_ = 0;             // of these
  Outgoing waiting_;
  bool gone_ = false;
};

}  // namespace

struct FrameServer::Parts {
  explicit Parts(const FramePlace& at)
      : listener(listen_for_frames(at, kWaiting)), place(place_of(listener.number(), at)) {}
  ~Parts() {
    if (place.is_local() && listener.number() >= 0) ::unlink(place.path.c_str());
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void accept() {
    OwnedDescriptor socket(
        ::accept4(listener.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (socket.number() < 0) return;
    ++counts.readers;
    if (readers.size() >= kMaxReaders) {
      ++counts.refused;
      return;
    }
    prepare_for_frames(socket.number());
    readers.emplace_back(std::move(socket));
  }

  void flush() {
    for (Reader& reader : readers) counts.sent += reader.flush();
    readers.erase(std::remove_if(readers.begin(), readers.end(),
                                 [](const Reader& reader) { return reader.is_gone(); }),
                  readers.end());
  }

  void wait(double timeout_s) {
    std::vector<pollfd> wanted{{listener.number(), POLLIN, 0}};
    for (const Reader& reader : readers) {
      wanted.push_back(
          {reader.descriptor(), short(reader.has_more() ? POLLIN | POLLOUT : POLLIN), 0});
    }
    const int ready = ::poll(wanted.data(), nfds_t(wanted.size()),
                             int(std::ceil(1000 * std::clamp(timeout_s, 0.0, kLongestWait_s))));
    if (ready <= 0) return;
    for (std::size_t i = 0; i < readers.size(); ++i) {
      if ((wanted[i + 1].revents & ~POLLOUT) != 0) readers[i].listen();
    }
    if (wanted[0].revents != 0) accept();
  }

  OwnedDescriptor listener;
  FramePlace place;
  std::deque<Reader> readers;
  FrameServerCounts counts;
};

FrameServer::FrameServer(const FramePlace& at) : parts_(std::make_unique<Parts>(at)) {}
FrameServer::FrameServer(FrameServer&&) noexcept = default;
FrameServer& FrameServer::operator=(FrameServer&&) noexcept = default;
FrameServer::~FrameServer() = default;

const FramePlace& FrameServer::place() const { return parts_->place; }
FrameServerCounts FrameServer::counts() const { return parts_->counts; }

void FrameServer::publish(const FrameHeader& header, Bytes pixels) {
  const bool is_a_frame = header.pixels() > 0 && header.width_px <= kMaxFrameSide_px &&
                          header.height_px <= kMaxFrameSide_px && std::isfinite(header.capture_s);
  if (!is_a_frame || header.pixels() != pixels.size) {
    throw std::invalid_argument("a frame of " + std::to_string(header.width_px) + "x" +
                                std::to_string(header.height_px) + " px with " +
                                std::to_string(pixels.size) + " bytes cannot be sent");
  }
  ++parts_->counts.published;
  for (Reader& reader : parts_->readers) {
    parts_->counts.replaced += reader.put(header, pixels) ? 1 : 0;
  }
  parts_->flush();
}

void FrameServer::serve(double timeout_s) {
  const double end_s = link_clock_s() + timeout_s;
  do {
    parts_->wait(std::max(0.0, end_s - link_clock_s()));
    parts_->flush();
  } while (link_clock_s() < end_s);
}

}  // namespace kestrel
