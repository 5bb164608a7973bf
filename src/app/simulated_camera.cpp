#include "simulated_camera.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/live_camera.hpp"
#include "kestrel/link/autopilot_link.hpp"
#include "kestrel/link/frame_reader.hpp"

#include "interrupt.hpp"

namespace kestrel::app {
namespace {

constexpr double kLook_s = 0.1;  // how often it is looked for Ctrl-C

class SimulatedCamera final : public FrameSource, public LiveClock {
 public:
  explicit SimulatedCamera(const FramePlace& place) : place_(place), reader_(place) {}

  std::optional<Frame> next() override {
    const double patience_s = last_ ? options_.stall_timeout_s : options_.open_timeout_s;
    for (const double end_s = link_clock_s() + patience_s; link_clock_s() < end_s;) {
      if (interrupted()) return std::nullopt;
      const std::optional<ReceivedFrame> received = reader_.next(kLook_s);
      note_problems();
      if (received && is_news(*received)) return framed(*received);
    }
    throw std::runtime_error(
        fmt::format("sim:{}: no frame for {} s; {}", to_string(place_), patience_s, why()));
  }

  const std::vector<std::string>& skipped() const override { return skipped_; }
  std::optional<std::int64_t> frame_count() const override { return std::nullopt; }
  double stamp_origin_s() const override { return origin_s_; }

 private:
  struct Last {
    double stamp_s = 0;
    long connection = 0;
    std::int64_t index = 0;
    std::uint64_t number = 0;
  };

  void note_problems() {
    for (const std::string& problem : reader_.take_problems()) skipped_.push_back(problem);
  }

  std::string why() const {
    const std::string last = reader_.last_problem();
    return last.empty() ? "the other end is silent" : last;
  }

  bool is_news(const ReceivedFrame& f) const {
    return !last_ || f.capture_s - origin_s_ > last_->stamp_s;
  }

  /// Numbers that go on leave their gaps in the index; those of another connection may start anew.
  Frame framed(const ReceivedFrame& f) {
    Frame frame;
    frame.stamp_s = f.capture_s - origin_s_;
    if (last_) {
      const bool goes_on = f.header.number > last_->number && f.connection == last_->connection;
      frame.index = last_->index + (goes_on ? std::int64_t(f.header.number - last_->number) : 1);
    }
    frame.gray.create(int(f.header.height_px), int(f.header.width_px), CV_8U);
    std::copy(f.pixels.begin(), f.pixels.end(), frame.gray.ptr<std::uint8_t>());
    last_ = Last{frame.stamp_s, f.connection, frame.index, f.header.number};
    return frame;
  }

  const FramePlace place_;
  const LiveOptions options_;
  const double origin_s_ = link_clock_s();
  FrameReader reader_;
  std::optional<Last> last_;
  std::vector<std::string> skipped_;
};

}  // namespace

std::unique_ptr<FrameSource> open_simulated_camera(const std::string& place) {
  return std::make_unique<SimulatedCamera>(parse_frame_place(place));
}

}  // namespace kestrel::app
