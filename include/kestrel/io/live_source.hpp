#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/io/camera_device.hpp"
#include "kestrel/io/live_options.hpp"
#include "kestrel/vision/frame.hpp"

namespace kestrel {

/// How a live source has fared so far.
struct LiveStatus {
  std::int64_t captured = 0;     // pictures that came whole
  std::int64_t dropped = 0;      // of these, let go because nobody took them in time
  std::int64_t lost = 0;         // that driver or bus say they lost
  std::int64_t damaged = 0;      // that came damaged, or of another size than the first
  std::int64_t connections = 0;  // 1: it never had to be opened again
  double longest_silence_s = 0;  // between two pictures
  CaptureClock clock = CaptureClock::Arrival;
  std::string trouble;  // why it is not connected at present; empty: it is
};

/// Whether the first opening is tried once (a camera that must be there) or until open_timeout_s (a
/// sender that may start late).
enum class FirstOpening { Once, UntilTimeout };

/// A camera that runs by itself. A thread of its own reads every picture and keeps the newest
/// (queue_pictures of them), so neither waits for the other. A camera that fails, ends or gives no
/// picture for stall_timeout_s is closed and opened again, with growing pauses.
class LiveSource : public FrameSource {
 public:
  /// Opens the camera. Throws std::invalid_argument as LiveOptions::check, std::runtime_error as
  /// `open` when the first opening fails. address stands for the camera in messages.
  LiveSource(std::string address, OpenCamera open, const LiveOptions& options, FirstOpening first);
  /// Ends the thread; waits for what the camera is doing, a tenth of a second or so.
  ~LiveSource() override;
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  /// The next picture kept. Pictures that nobody got are gaps in the index; stamps are capture
  /// times and always increase. When none came for blind_s, a frame without an image (has_image is
  /// false) with the stamp that a picture would have now, and again every tenth of a second: who
  /// flies must hear that it sees nothing. The very first frame has an image always. Throws
  /// std::runtime_error when no picture came for give_up_s (the first: for open_timeout_s).
  std::optional<Frame> next() override;

  /// What happened to the connection and to damaged pictures, one sentence each; at most 200 of
  /// them.
  const std::vector<std::string>& skipped() const override;
  std::optional<std::int64_t> frame_count() const override { return std::nullopt; }

  /// What the monotonic clock (monotonic_clock_s) was when the stamps were zero.
  double stamp_origin_s() const;

  LiveStatus status() const;

 private:
  struct Reader;
  Frame frame_of(Picture picture);
  Frame blind_frame();
  void collect_words();

  const std::string address_;
  const LiveOptions options_;
  const double origin_s_;
  std::vector<std::string> skipped_;
  std::int64_t index_ = -1;             // of the last frame given
  double stamp_s_ = 0;                  // of the last frame given
  std::optional<double> last_image_s_;  // when the last image was given, on the monotonic clock
  double last_image_stamp_s_ = 0;
  std::unique_ptr<Reader> reader_;
};

/// What the monotonic clock was when the stamps of a source were zero; empty for one that does not
/// run by itself, a recording for instance.
std::optional<double> stamp_origin_s(const FrameSource& source);

/// The status of a source; empty for one that does not run by itself.
std::optional<LiveStatus> live_status(const FrameSource& source);

}  // namespace kestrel
