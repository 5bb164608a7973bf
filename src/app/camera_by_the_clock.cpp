#include "camera_by_the_clock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kestrel/link/autopilot_link.hpp"

namespace kestrel::app {
namespace {

constexpr double kLongestTurn_s = 0.05;

}  // namespace

CameraByTheClock::CameraByTheClock(const OnboardCamera& camera, FrameServer& server,
                                   MotionAt motion_at, double rate_hz, double latency_s,
                                   double known_after_s)
    : camera_(camera),
      server_(server),
      motion_at_(std::move(motion_at)),
      rate_hz_(rate_hz),
      latency_s_(latency_s),
      known_after_s_(known_after_s),
      start_s_(link_clock_s()) {}

double CameraByTheClock::now_s() const { return link_clock_s() - start_s_; }

std::optional<Exposure> CameraByTheClock::turn() {
  const double known_s = due_s(next_) + known_after_s_;
  serve_until(std::min(known_s, link_clock_s() + kLongestTurn_s));
  const double now_s = link_clock_s();
  if (now_s < known_s) return std::nullopt;
  // Of several that are due by now the newest is taken: the others came too late to be seen.
  const auto newest = std::int64_t(std::floor((now_s - known_after_s_ - start_s_) * rate_hz_));
  counts_.late += std::max<std::int64_t>(newest - next_, 0);
  const std::int64_t number = std::max(newest, next_);
  next_ = number + 1;
  const auto vehicle = motion_at_(due_s(number));
  if (!vehicle) {
    ++counts_.unknown;
    return std::nullopt;
  }
  const Exposure exposure{number, due_s(number) - start_s_, *vehicle};
  take_picture(exposure);
  return exposure;
}

void CameraByTheClock::take_picture(const Exposure& exposure) {
  if (camera_.drops(exposure.number)) {
    ++counts_.dropped;
    return;
  }
  const double begun_s = link_clock_s();
  cv::Mat gray = camera_.look(exposure.vehicle, exposure.number, exposure.stamp_s).gray;
  render_ms_.push_back((link_clock_s() - begun_s) * 1e3);
  ++counts_.rendered;
  FrameHeader header;
  header.width_px = std::uint32_t(gray.cols);
  header.height_px = std::uint32_t(gray.rows);
  header.number = std::uint64_t(exposure.number);
  header.capture_s = due_s(exposure.number);
  pending_.push_back({header.capture_s + latency_s_, header, std::move(gray)});
  serve_until(link_clock_s());
}

void CameraByTheClock::serve_until(double clock_s) {
  do {
    while (!pending_.empty() && pending_.front().publish_s <= link_clock_s()) {
      const Pending& first = pending_.front();
      server_.publish(first.header, {first.gray.data, first.header.pixels()});
      pending_.pop_front();
    }
    const double next_s =
        pending_.empty() ? clock_s : std::min(clock_s, pending_.front().publish_s);
    server_.serve(next_s - link_clock_s());
  } while (link_clock_s() < clock_s);
}

}  // namespace kestrel::app
