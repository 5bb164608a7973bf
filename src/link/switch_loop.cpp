#include "kestrel/link/switch_loop.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace kestrel {
namespace {

constexpr std::uint64_t kStatusTag = std::uint64_t(kMaxPorts) << 32;
// The core is asked what is due more often than flight control is sent to: the deadman is then
// late by no more than this.
constexpr double kTick_s = 0.005;
constexpr int kGoodbyes = 3;
constexpr double kLongestGoodbye_s = 0.2;

SwitchOptions with_transports(const SwitchLoopOptions& options) {
  options.check();
  SwitchOptions core = options.core;
  for (std::size_t i = 0; i < core.links.size(); ++i) {
    core.links[i].transport =
        is_stream(options.places[i].place.kind) ? Transport::Stream : Transport::Datagram;
  }
  return core;
}

/// The links with flight control first, else as they stand.
std::vector<std::size_t> order_of_service(const std::vector<SwitchLink>& links) {
  std::vector<std::size_t> order(links.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return links[i].role == LinkRole::Flight; });
  return order;
}

std::vector<std::size_t> inverse(const std::vector<std::size_t>& order) {
  std::vector<std::size_t> result(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) result[order[i]] = i;
  return result;
}

}  // namespace

void SwitchLoopOptions::check() const {
  core.check();
  if (places.size() != core.links.size()) {
    throw std::invalid_argument("places must be as many as links");
  }
  if (places.size() > kMaxPorts) throw std::invalid_argument("links must be at most 255");
  if (batch == 0) throw std::invalid_argument("batch must be at least 1");
  for (const SwitchPlace& each : places) each.port.check();
}

SwitchLoop::SwitchLoop(const SwitchLoopOptions& options, Clock clock)
    : options_(options),
      clock_(std::move(clock)),
      core_(with_transports(options)),
      link_of_(order_of_service(options.core.links)),
      number_of_(inverse(link_of_)),
      next_tick_s_(clock_().now_s) {
  ports_.reserve(link_of_.size());
  for (std::size_t number = 0; number < link_of_.size(); ++number) {
    const SwitchPlace& at = options_.places[link_of_[number]];
    ports_.push_back(open_link_port(at.place, at.port, number, poller_));
  }
  if (options_.status.empty()) return;
  status_ = std::make_unique<StatusServer>(options_.status);
  poller_.watch(status_->descriptor(), kStatusTag);
}

void SwitchLoop::turn() {
  const std::vector<std::uint64_t>& ready = poller_.wait(next_tick_s_ - clock_().now_s);
  const double start_s = clock_().now_s;
  for (const std::uint64_t tag : ready) serve(tag);
  const SwitchTime end = clock_();
  keep_time(end);
  ++turns_;
  longest_turn_s_ = std::max(longest_turn_s_, end.now_s - start_s);
}

void SwitchLoop::serve(std::uint64_t tag) {
  if (tag == kStatusTag) {
    status_->answer([this] { return status_json(report()) + "\n"; });
    return;
  }
  const auto number = std::size_t(tag >> 32);
  for (std::size_t i = 0; i < options_.batch; ++i) {
    const SwitchTime time = clock_();
    const std::optional<PortEvent> event = ports_[number]->next(tag, time.now_s);
    if (!event) return;
    handle(number, *event, time);
  }
}

void SwitchLoop::handle(std::size_t number, const PortEvent& event, const SwitchTime& time) {
  if (event.came) core_.connect(event.peer, link_of_[number], event.from, time);
  if (event.bytes.size > 0) deliver(core_.receive(event.peer, event.bytes, time));
  if (event.went) core_.disconnect(event.peer, time);
}

void SwitchLoop::deliver(const std::vector<Delivery>& deliveries) {
  for (const Delivery& each : deliveries) {
    const std::size_t number = port_of(each.to);
    if (number < ports_.size()) ports_[number]->send(each.to, each.bytes);
  }
}

void SwitchLoop::keep_time(const SwitchTime& time) {
  if (time.now_s < next_tick_s_) return;
  // By the schedule, not by when it was woken; after a stop of the machine anew.
  next_tick_s_ = std::max(next_tick_s_ + kTick_s, time.now_s);
  deliver(core_.tick(time));
  for (std::size_t number = 0; number < ports_.size(); ++number) {
    while (const std::optional<PortEvent> event = ports_[number]->due(time.now_s)) {
      handle(number, *event, time);
    }
  }
}

void SwitchLoop::shutdown() {
  const double until_s = clock_().now_s + kLongestGoodbye_s;
  for (int i = 0; i < kGoodbyes; ++i) {
    deliver(core_.shutdown(clock_()));
    const double next_s = clock_().now_s + kLongestGoodbye_s / (2 * kGoodbyes);
    for (SwitchTime time = clock_(); time.now_s < std::min(next_s, until_s); time = clock_()) {
      // Nothing is obeyed any more, but what waits for room goes out.
      for (const std::uint64_t tag : poller_.wait(next_s - time.now_s)) {
        if (tag < kStatusTag) ports_[std::size_t(tag >> 32)]->next(tag, time.now_s);
      }
    }
  }
}

SwitchReport SwitchLoop::report() const {
  SwitchReport report;
  report.core = core_.status(clock_());
  for (std::size_t link = 0; link < options_.core.links.size(); ++link) {
    const SwitchLink& told = options_.core.links[link];
    const LinkPort& port = *ports_[number_of_[link]];
    report.links.push_back(
        {told.name, told.role, {options_.places[link].place.kind, port.address()}, port.counts()});
  }
  for (const PeerStatus& peer : report.core.peers) {
    report.traffic.push_back(ports_[port_of(peer.peer)]->traffic(peer.peer));
  }
  report.turns = turns_;
  report.longest_turn_s = longest_turn_s_;
  return report;
}

}  // namespace kestrel
