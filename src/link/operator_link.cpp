#include "kestrel/link/operator_link.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "kestrel/link/autopilot_link.hpp"

namespace kestrel {
namespace {

constexpr double kHeartbeatPeriod_s = 1;
constexpr int kMostDatagrams = 16;  // a turn, as the switch: a flood holds up no stop
constexpr double kLongestFarewell_s = 0.5;
constexpr std::chrono::milliseconds kFarewellTurn{5};

OperatorLinkOptions checked(const OperatorLinkOptions& options) {
  options.check();
  return options;
}

mavlink::Heartbeat heartbeat() {
  mavlink::Heartbeat beat;
  beat.type = 6;  // MAV_TYPE_GCS
  return beat;
}

}  // namespace

void OperatorLinkOptions::check() const {
  if (system_id == 0) throw std::invalid_argument("system_id: must be 1 to 255");
  if (component_id == 0) throw std::invalid_argument("component_id: must be 1 to 255");
  if (key && !unix_s) throw std::invalid_argument("unix_s: signatures need a clock");
}

OperatorLink::OperatorLink(const Address& to, const OperatorLinkOptions& options)
    : to_(to),
      options_(checked(options)),
      socket_(UdpSocket::connected_to(to)),
      operator_(options.self) {
  // What was signed before now may be sent again by whoever heard it then.
  if (options_.key) {
    checker_.emplace(*options_.key, mavlink::signing_time(options_.unix_s()));
  }
}

OperatorLink::~OperatorLink() {
  if (status().holds) release();
  for (const double end_s = link_clock_s() + kLongestFarewell_s; link_clock_s() < end_s;) {
    look_after();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!operator_.owes()) return;
    }
    std::this_thread::sleep_for(kFarewellTurn);
  }
}

void OperatorLink::send(const VelocityCommand& command, double) noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  transmit(velocity_setpoint(command, time_boot_ms(link_clock_s()), options_.vehicle));
}

void OperatorLink::take_over() {
  const std::lock_guard<std::mutex> lock(mutex_);
  operator_.take_over();
  transmit_due();
}

void OperatorLink::zero() { send(VelocityCommand::hover(), 0); }

void OperatorLink::release() {
  zero();
  const std::lock_guard<std::mutex> lock(mutex_);
  operator_.release();
  transmit_due();
}

void OperatorLink::stop() {
  zero();
  const std::lock_guard<std::mutex> lock(mutex_);
  operator_.stop();
  transmit_due();
}

void OperatorLink::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  operator_.reset();
  transmit_due();
}

void OperatorLink::look_after() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (int i = 0; i < kMostDatagrams; ++i) {
    const auto datagram = socket_.take();
    if (!datagram) break;
    hear(datagram->bytes);
  }
  const double now_s = link_clock_s();
  if (!next_heartbeat_s_ || now_s >= *next_heartbeat_s_) {
    next_heartbeat_s_ = now_s + kHeartbeatPeriod_s;
    transmit(heartbeat());
  }
  transmit_due();
}

/// With the mutex held.
void OperatorLink::transmit_due() {
  if (const auto command = operator_.due(link_clock_s())) transmit(*command);
}

void OperatorLink::hear(Bytes datagram) {
  for (Bytes rest = datagram; rest.size > 0;) {
    const mavlink::Parsed parsed = mavlink::parse(rest);
    rest = rest.after(parsed.size);
    const auto* frame = std::get_if<mavlink::FrameView>(&parsed.content);
    if (frame == nullptr || frame->info == nullptr || !is_genuine(*frame)) continue;
    const auto message = mavlink::message_of(frame->message_id(), frame->payload());
    if (message) operator_.hear({frame->envelope(), *message}, link_clock_s());
  }
}

bool OperatorLink::is_genuine(const mavlink::FrameView& frame) {
  return !checker_ || checker_->check(frame, options_.unix_s()) == mavlink::Verdict::Genuine;
}

/// With the mutex held. Times follow the clock, and never repeat.
mavlink::SigningStamp OperatorLink::stamp() {
  last_signing_time_ = std::max(mavlink::signing_time(options_.unix_s()), last_signing_time_ + 1);
  return {0, last_signing_time_};
}

/// With the mutex held. A frame that is not sent keeps its number: the switch is to see the gap.
void OperatorLink::transmit(const mavlink::Message& message) {
  const mavlink::Envelope envelope{options_.system_id, options_.component_id, sequence_++};
  const mavlink::EncodedFrame frame =
      options_.key ? mavlink::signed_frame(message, envelope, stamp(), *options_.key)
                   : mavlink::encode(message, envelope);
  if (socket_.send(frame.bytes()) != Sent::Yes) ++failures_;
}

OperatorStatus OperatorLink::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return operator_.status(link_clock_s());
}

std::vector<std::string> OperatorLink::take_words() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return operator_.take_words();
}

}  // namespace kestrel
