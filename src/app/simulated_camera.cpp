#include "simulated_camera.hpp"

#include <algorithm>
#include <stdexcept>

#include "kestrel/io/live_camera.hpp"
#include "kestrel/io/source_address.hpp"
#include "kestrel/link/frame_reader.hpp"

namespace kestrel::app {
namespace {

constexpr double kWait_s = 0.1;  // of a device for its next picture

class SimulatedCamera final : public CameraDevice {
 public:
  /// Waits for somebody who sends.
  SimulatedCamera(const FramePlace& place, const StopAsked& stop, double timeout_s)
      : name_("sim:" + to_string(place)), reader_(place) {
    const double until_s = monotonic_clock_s() + timeout_s;
    while (!waiting_ && !stop() && monotonic_clock_s() < until_s) waiting_ = reader_.next(kWait_s);
    if (!waiting_) throw std::runtime_error(name_ + ": " + why());
    reader_.take_problems();  // of the time before somebody was there
  }

  std::optional<Picture> next() override {
    std::optional<ReceivedFrame> frame;
    frame.swap(waiting_);
    if (!frame) frame = reader_.next(kWait_s);
    const std::vector<std::string> problems = reader_.take_problems();
    if (!problems.empty()) throw std::runtime_error(name_ + ": " + problems.back());
    if (!frame) return std::nullopt;
    return picture_of(*frame);
  }

  CaptureClock clock() const override { return CaptureClock::Driver; }

 private:
  std::string why() const {
    const std::string last = reader_.last_problem();
    return last.empty() ? "the other end is silent" : last;
  }

  Picture picture_of(const ReceivedFrame& frame) {
    Picture picture;
    picture.captured_s = frame.capture_s;
    if (last_number_ && frame.header.number > *last_number_) {
      picture.lost = std::int64_t(frame.header.number - *last_number_ - 1);
    }
    last_number_ = frame.header.number;
    picture.gray.create(int(frame.header.height_px), int(frame.header.width_px), CV_8U);
    std::copy(frame.pixels.begin(), frame.pixels.end(), picture.gray.ptr<std::uint8_t>());
    return picture;
  }

  const std::string name_;
  FrameReader reader_;
  std::optional<ReceivedFrame> waiting_;
  std::optional<std::uint64_t> last_number_;
};

}  // namespace

std::unique_ptr<LiveSource> open_camera(const std::string& address, const LiveOptions& options) {
  const SourceAddress source = parse_source(address);
  if (source.kind != SourceKind::Simulated) return open_live(address, options);
  if (!options.capture.is_empty()) {
    throw std::invalid_argument(address +
                                ": frames come as the simulation renders them; set size "
                                "and rate in its task, not here");
  }
  const FramePlace place = parse_frame_place(source.place);
  const OpenCamera open = [place](const StopAsked& stop, double timeout_s) {
    return std::make_unique<SimulatedCamera>(place, stop, timeout_s);
  };
  return std::make_unique<LiveSource>(address, open, options, FirstOpening::UntilTimeout);
}

}  // namespace kestrel::app
