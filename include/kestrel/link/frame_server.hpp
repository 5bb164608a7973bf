#pragma once

#include <memory>

#include "kestrel/link/bytes.hpp"
#include "kestrel/link/frame_header.hpp"
#include "kestrel/link/frame_place.hpp"

namespace kestrel {

struct FrameServerCounts {
  long published = 0;
  long sent = 0;      // whole, each reader's by itself
  long replaced = 0;  // never begun: a newer one came before the reader had taken what was before
  long readers = 0;   // that have connected
  long refused = 0;   // of these, turned away: kMaxReaders were there
};

/// Where a camera's frames are had (FrameReader, and whoever reads FrameHeader). A reader that is
/// slow loses frames: of those that wait for it the newest only is kept; nobody else waits for it.
/// For one thread, which has to call serve() while it has nothing else to do.
class FrameServer {
 public:
  static constexpr std::size_t kMaxReaders = 8;

  /// Listens there; port 0 takes any free one, a local socket is for this user only. Throws
  /// std::runtime_error when that cannot be.
  explicit FrameServer(const FramePlace& at);
  FrameServer(FrameServer&&) noexcept;
  FrameServer& operator=(FrameServer&&) noexcept;
  ~FrameServer();

  /// Where it listens, with its real port.
  const FramePlace& place() const;

  /// Hands the frame to each reader; sent_s of the header is filled in when it leaves, by
  /// link_clock_s(), of which capture_s must be a time not in the future. Throws
  /// std::invalid_argument when the header does not fit the pixels.
  void publish(const FrameHeader& header, Bytes pixels);

  /// Lets readers come, and sends to them what waits, for timeout_s; at least once.
  void serve(double timeout_s);

  FrameServerCounts counts() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kestrel
