#include "vehicle_server.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "kestrel/link/autopilot_link.hpp"

namespace kestrel::app {
namespace {

constexpr double kTurn_s = 0.005;

FlyingVehicleOptions booted_at(double boot_s, FlyingVehicleOptions options) {
  options.rules.boot_s = boot_s;
  return options;
}

}  // namespace

VehicleServer::VehicleServer(const Address& at, FlyingVehicleOptions options)
    : booted_s_(link_clock_s()),
      socket_(UdpSocket::bound_to(at)),
      vehicle_(booted_at(booted_s_, std::move(options))),
      flown_to_s_(booted_s_) {
  thread_ = std::thread([this] { run(); });
}

VehicleServer::~VehicleServer() {
  stop_ = true;
  thread_.join();
}

void VehicleServer::run() noexcept {
  try {
    while (!stop_) turn();
  } catch (const std::exception& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    broken_ = error.what();
  }
}

void VehicleServer::turn() {
  const auto datagram = socket_.receive(kTurn_s);
  FlyingVehicle::Frames due;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const double now_s = link_clock_s();
    latest_s_ = std::max(latest_s_, now_s - flown_to_s_);
    due = std::exchange(untold_, {});
    auto more = datagram ? vehicle_.receive(datagram->bytes, now_s) : vehicle_.fly_until(now_s);
    due.insert(due.end(), more.begin(), more.end());
    flown_to_s_ = now_s;
  }
  if (datagram) peers_.heard(datagram->from, link_clock_s());
  send(due);
}

/// Answers go to all as well: whom they concern, they name.
void VehicleServer::send(const FlyingVehicle::Frames& frames) {
  for (const auto& [peer, heard_s] : peers_.all()) {
    for (const auto& frame : frames) socket_.send_to(peer, frame.bytes());
  }
}

std::optional<TrueMotion> VehicleServer::motion_at(double clock_s) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto more = vehicle_.fly_until(std::min(clock_s, link_clock_s()));
  untold_.insert(untold_.end(), more.begin(), more.end());
  return vehicle_.motion_at(clock_s);
}

std::vector<std::string> VehicleServer::take_events() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> lines;
  for (const AutopilotEvent& event : vehicle_.take_events()) {
    lines.push_back(fmt::format("{:9.3f} s  {}", event.at_s - booted_s_, event.what));
  }
  if (!broken_.empty()) lines.push_back(std::exchange(broken_, {}));
  return lines;
}

void VehicleServer::report(Summary& summary) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  vehicle_.report(summary);
  summary.add("longest pause of the flight", latest_s_ * 1e3, "ms");
}

}  // namespace kestrel::app
