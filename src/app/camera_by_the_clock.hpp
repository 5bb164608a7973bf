#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "kestrel/link/frame_server.hpp"
#include "kestrel/sim/onboard_camera.hpp"

namespace kestrel::app {

/// How the frames of a camera by the clock were made.
struct CameraCounts {
  std::int64_t rendered = 0;
  std::int64_t late = 0;     // not rendered: the one before was ready too late
  std::int64_t dropped = 0;  // by the task's drop_share
  std::int64_t unknown = 0;  // nobody knew where the vehicle was
};

/// A frame's moment: when it was due, and how the vehicle moved then.
struct Exposure {
  std::int64_t number = 0;
  double stamp_s = 0;  // since the flight began
  TrueMotion vehicle;
};

/// Takes a picture whenever one is due, and serves it latency_s after its capture. Time is never
/// stretched: what is late is left out and counted.
class CameraByTheClock {
 public:
  /// Where the vehicle was at a time of link_clock_s().
  using MotionAt = std::function<std::optional<TrueMotion>(double clock_s)>;

  /// known_after_s: how long after a moment motion_at can be asked for it.
  CameraByTheClock(const OnboardCamera& camera, FrameServer& server, MotionAt motion_at,
                   double rate_hz, double latency_s, double known_after_s);

  /// Serves frames up to some 50 ms, or until the next one was taken: what was then seen. Empty
  /// when none was due, or the vehicle's place was not known.
  std::optional<Exposure> turn();

  /// Seconds since the flight began.
  double now_s() const;

  const CameraCounts& counts() const { return counts_; }
  const std::vector<double>& render_ms() const { return render_ms_; }

 private:
  struct Pending {
    double publish_s = 0;
    FrameHeader header;
    cv::Mat gray;
  };
  double due_s(std::int64_t number) const { return start_s_ + double(number) / rate_hz_; }
  void serve_until(double clock_s);
  void take_picture(const Exposure& exposure);

  const OnboardCamera& camera_;
  FrameServer& server_;
  MotionAt motion_at_;
  double rate_hz_;
  double latency_s_;
  double known_after_s_;
  double start_s_;
  std::int64_t next_ = 0;
  std::deque<Pending> pending_;
  CameraCounts counts_;
  std::vector<double> render_ms_;
};

}  // namespace kestrel::app
