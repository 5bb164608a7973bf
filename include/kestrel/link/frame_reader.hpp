#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "kestrel/link/frame_clock.hpp"
#include "kestrel/link/frame_header.hpp"
#include "kestrel/link/frame_place.hpp"

namespace kestrel {

/// A frame as it was sent, dated by our clock.
struct ReceivedFrame {
  FrameHeader header;
  double capture_s = 0;              // by link_clock_s()
  std::vector<std::uint8_t> pixels;  // header.pixels() of them, row by row
  long connection = 1;               // the how many-th it came over: numbers may start anew
};

struct FrameReaderCounts {
  long received = 0;     // whole frames
  long replaced = 0;     // of these, never taken: a newer one came first
  long connections = 0;  // that came about
  long broken = 0;       // of these, ended within a frame or by what was no frame
};

/// Reads what a FrameServer sends: a thread keeps the newest frame only, and connects again, for
/// ever, whenever the stream ends, is no stream of frames, or stands still within a frame.
class FrameReader {
 public:
  /// Begins to connect; whether anybody is there turns out later.
  explicit FrameReader(const FramePlace& from);
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// The newest frame that was not given yet; waits up to timeout_s for one. Empty after that.
  std::optional<ReceivedFrame> next(double timeout_s);

  /// What went wrong since the last call, one sentence each; not the same twice in a row.
  std::vector<std::string> take_problems();

  /// The last of all problems; empty when there was none.
  std::string last_problem() const;

  FrameReaderCounts counts() const;

 private:
  void run() noexcept;
  void read_stream(int descriptor);
  bool read(int descriptor, std::uint8_t* to, std::size_t size, const std::string& what);
  void keep(ReceivedFrame frame);
  void note(const std::string& problem);

  const FramePlace from_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;  // of all that follows, but the thread
  std::condition_variable changed_;
  std::optional<ReceivedFrame> newest_;
  std::vector<std::string> problems_;
  std::string last_problem_;
  FrameReaderCounts counts_;
  std::thread thread_;
};

}  // namespace kestrel
