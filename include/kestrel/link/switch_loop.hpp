#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "kestrel/link/link_port.hpp"
#include "kestrel/link/status_server.hpp"
#include "kestrel/link/switch_core.hpp"
#include "kestrel/link/switch_report.hpp"

namespace kestrel {

/// Where one link of the switch is, and whom it keeps.
struct SwitchPlace {
  LinkPlace place;
  PortOptions port;
};

struct SwitchLoopOptions {
  SwitchOptions core;               // `transport` of its links follows from the places
  std::vector<SwitchPlace> places;  // one for each of core.links, in their order
  std::filesystem::path status;     // local socket that tells the status; empty: none
  std::size_t batch = 16;           // most that one socket is served before the others are

  /// Throws std::invalid_argument that names the option.
  void check() const;
};

/// The switch with its sockets: one thread, one epoll. Flight control is served first; of each
/// socket at most `batch` datagrams or chunks are taken before the others have their turn, so that
/// no flood delays a setpoint; nothing is ever waited for but the next event.
class SwitchLoop {
 public:
  using Clock = std::function<SwitchTime()>;

  /// Opens all links. Throws std::invalid_argument as the options do, std::runtime_error when a
  /// link cannot be opened.
  SwitchLoop(const SwitchLoopOptions& options, Clock clock);

  /// Waits until something is there, or the next setpoint is due, and serves it. A signal ends the
  /// wait. Throws nothing in flight.
  void turn();

  /// Sends zeros to flight control, three times in case one is lost, and what waits, for at most
  /// 0.2 s.
  void shutdown();

  SwitchReport report() const;
  std::vector<SwitchEvent> take_events() { return core_.take_events(); }
  /// Where a link listens, with the real port.
  Address address(std::size_t link) const { return ports_[number_of_[link]]->address(); }

 private:
  void serve(std::uint64_t tag);
  void handle(std::size_t number, const PortEvent& event, const SwitchTime& time);
  void deliver(const std::vector<Delivery>& deliveries);
  void keep_time(const SwitchTime& time);

  SwitchLoopOptions options_;
  Clock clock_;
  SwitchCore core_;
  Poller poller_;
  std::vector<std::size_t> link_of_;    // by the number of a port: flight control's are the lowest
  std::vector<std::size_t> number_of_;  // the inverse
  std::vector<std::unique_ptr<LinkPort>> ports_;
  std::unique_ptr<StatusServer> status_;
  double next_tick_s_;
  std::uint64_t turns_ = 0;
  double longest_turn_s_ = 0;
};

}  // namespace kestrel
