#include "stand_in.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "kestrel/link/autopilot_link.hpp"

#include "command_csv.hpp"

namespace kestrel::app {
namespace {

constexpr double kStep_s = 0.01;

VehicleTruth start(const AutopilotModelOptions& rules) {
  VehicleTruth truth;
  truth.position_ned_m.z() = rules.starts_armed ? -10 : 0;
  return truth;
}

AutopilotModelOptions booted_at(double boot_s, AutopilotModelOptions rules) {
  rules.boot_s = boot_s;
  return rules;
}

}  // namespace

StandIn::StandIn(const Address& at, const AutopilotModelOptions& rules)
    : booted_s_(link_clock_s()),
      socket_(UdpSocket::bound_to(at)),
      model_(booted_at(booted_s_, rules)),
      vehicle_(start(rules)),
      received_(rules.me),
      flown_s_(booted_s_) {}

std::vector<ReceivedCommand> StandIn::poll(double timeout_s) {
  std::vector<ReceivedCommand> commands;
  const double end_s = link_clock_s() + timeout_s;
  for (double now_s = link_clock_s(); now_s < end_s; now_s = link_clock_s()) {
    if (const auto datagram = socket_.receive(std::min(kStep_s, end_s - now_s))) {
      peers_.heard(datagram->from, now_s);
      const auto more = received_.take(datagram->bytes, datagram->from);
      commands.insert(commands.end(), more.begin(), more.end());
      const Address from = datagram->from;
      send_to(from, model_.receive(datagram->bytes, vehicle_.truth(), link_clock_s()));
    }
    fly();
  }
  return commands;
}

void StandIn::fly() {
  const double now_s = link_clock_s();
  if (now_s - flown_s_ < kStep_s) return;
  send(model_.tick(vehicle_.truth(), now_s));
  vehicle_.move(model_.reference(), now_s - flown_s_);
  flown_s_ = now_s;
}

void StandIn::send(const AutopilotModel::Frames& frames) {
  for (const auto& [peer, heard_s] : peers_.all()) send_to(peer, frames);
}

void StandIn::send_to(const Address& peer, const AutopilotModel::Frames& frames) {
  for (const auto& frame : frames) socket_.send_to(peer, frame.bytes());
}

std::vector<std::string> StandIn::take_events() {
  std::vector<std::string> lines;
  for (const AutopilotEvent& event : model_.take_events()) {
    lines.push_back(fmt::format("{:9.3f} s  {}", event.at_s - booted_s_, event.what));
  }
  return lines;
}

void StandIn::report(Summary& summary) const {
  const Eigen::Vector3d& p = vehicle_.truth().position_ned_m;
  summary.begin_section("autopilot");
  add_counts(summary, model_.counts());
  summary.add("alive", model_.alive());
  summary.add("armed", model_.armed());
  summary.add("speed", vehicle_.truth().velocity_ned_m_s.norm(), "m/s");
  summary.add("north", p.x(), "m");
  summary.add("east", p.y(), "m");
  summary.add("down", p.z(), "m");
}

}  // namespace kestrel::app
