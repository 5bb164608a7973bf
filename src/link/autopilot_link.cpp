#include "kestrel/link/autopilot_link.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>

namespace kestrel {
namespace {

constexpr std::size_t kMaxSent = 4096;    // more than three minutes at 20 Hz
constexpr double kLongestFarewell_s = 5;  // an autopilot that never answers is left after this

bool has_setpoint(const mavlink::EncodedFrame& frame) {
  const auto parsed = mavlink::frame_at_start(frame.bytes());
  const auto* view = std::get_if<mavlink::FrameView>(&parsed.content);
  return view != nullptr && view->message_id() == 84;
}

void pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(std::max(0.0, seconds)));
}

}  // namespace

double link_clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

AutopilotLink::AutopilotLink(const Address& to, const AutopilotOptions& options,
                             std::optional<double> stamp_origin_s)
    : period_s_(1 / options.rate_hz),
      stamp_origin_s_(stamp_origin_s),
      socket_(UdpSocket::connected_to(to)),
      adapter_(options) {
  thread_ = std::thread([this] { run(); });
}

AutopilotLink::~AutopilotLink() { stop(); }

double AutopilotLink::capture_s(double stamp_s, double now_s) {
  if (stamp_origin_s_) return stamp_s + *stamp_origin_s_;
  if (!std::isfinite(stamp_s)) return stamp_s;
  if (!last_stamp_s_ || stamp_s > *last_stamp_s_) {
    last_stamp_s_ = stamp_s;
    last_capture_s_ = now_s;
  }
  return last_capture_s_;
}

void AutopilotLink::send(const VelocityCommand& command, double stamp_s) noexcept {
  const double now_s = link_clock_s();
  const std::lock_guard<std::mutex> lock(mutex_);
  adapter_.decide(command, capture_s(stamp_s, now_s), now_s);
}

void AutopilotLink::request_control() {
  const std::lock_guard<std::mutex> lock(mutex_);
  adapter_.request_control();
}

void AutopilotLink::request_landing() {
  const std::lock_guard<std::mutex> lock(mutex_);
  adapter_.request_landing();
}

void AutopilotLink::stop() noexcept {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

std::optional<Attitude> AutopilotLink::attitude_at(double stamp_s) const {
  if (!stamp_origin_s_) return std::nullopt;
  return attitude_at_clock(stamp_s + *stamp_origin_s_);
}

std::optional<Attitude> AutopilotLink::attitude_at_clock(double clock_s) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return adapter_.attitude_at(clock_s);
}

std::optional<VehicleMotion> AutopilotLink::motion_at(double clock_s) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return adapter_.motion_at(clock_s);
}

AdapterStatus AutopilotLink::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return adapter_.status(link_clock_s());
}

void AutopilotLink::run() noexcept {
  try {
    run_until_released();
  } catch (...) {
    // Without memory for a frame nothing can be sent: silence, and the autopilot's failsafe.
    ++failures_;
  }
}

void AutopilotLink::run_until_released() {
  std::optional<double> leave_s;
  for (double next_s = link_clock_s();;) {
    const double now_s = link_clock_s();
    if (stopping_ && !leave_s) leave_s = now_s + kLongestFarewell_s;
    AutopilotAdapter::Frames due;
    std::optional<StreamSetpoint> setpoint;
    bool is_over = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (leave_s) adapter_.release(now_s);
      due = adapter_.tick(now_s);
      setpoint = adapter_.ticked_setpoint();
      is_over = leave_s && (adapter_.released() || now_s > *leave_s);
    }
    if (transmit(due) && setpoint) note_sent(*setpoint);
    if (is_over) return;
    next_s = std::max(next_s + period_s_, now_s);
    listen(next_s);
  }
}

void AutopilotLink::listen(double until_s) {
  // After a broken socket the setpoints go on, and fail, and are counted.
  try {
    for (double left_s = until_s - link_clock_s(); left_s > 0; left_s = until_s - link_clock_s()) {
      const std::optional<Datagram> datagram = socket_.receive(left_s);
      if (!datagram) continue;
      AutopilotAdapter::Frames answers;
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        answers = adapter_.receive(datagram->bytes, link_clock_s());
      }
      transmit(answers);
    }
  } catch (const std::system_error&) {
    pause(until_s - link_clock_s());
  }
}

void AutopilotLink::note_sent(const StreamSetpoint& setpoint) {
  const double sent_s = link_clock_s();
  const std::lock_guard<std::mutex> lock(mutex_);
  sent_.push_back({sent_s, setpoint.stamp_s, setpoint.state});
  if (sent_.size() > kMaxSent) sent_.pop_front();
}

std::vector<SentSetpoint> AutopilotLink::take_sent() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<SentSetpoint> sent(sent_.begin(), sent_.end());
  sent_.clear();
  return sent;
}

/// True when the network took all of them.
bool AutopilotLink::transmit(const AutopilotAdapter::Frames& frames) noexcept {
  bool all = true;
  for (const mavlink::EncodedFrame& frame : frames) {
    const Sent sent = socket_.send(frame.bytes());
    all = all && sent == Sent::Yes;
    if (sent != Sent::Yes && has_setpoint(frame)) ++failures_;
  }
  return all;
}

}  // namespace kestrel
