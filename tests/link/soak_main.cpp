// The switch under all that a bad world does at once, at ten times the usual rates:
//     soak [SECONDS=15]
// A companion over a bad UDP line, a script that floods, ground stations over a bad TCP line that
// is cut again and again, one of which never reads, and two hostile senders that change their
// ports; the vehicle reports at 500 Hz. Fails when memory or descriptors grow, a wrong command
// reaches the vehicle, or counts do not add up.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <unistd.h>

#include "link/running_switch.hpp"
#include "link/soak_peers.hpp"
#include "link/tcp_relay.hpp"
#include "link/udp_relay.hpp"

namespace kestrel::test {
namespace {

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0;
  file >> pages >> pages;
  return pages * double(sysconf(_SC_PAGESIZE)) / 1e6;
}

long open_descriptors() {
  return long(std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                            std::filesystem::directory_iterator()));
}

ImpairmentOptions poor_stream() {
  ImpairmentOptions line;
  line.loss = 0.02;
  line.corruption = 0.02;
  line.splitting = 0.5;
  line.delay_s = 0.02;
  line.jitter_s = 0.02;
  return line;
}

RelayOptions relay_to(const Address& to, const ImpairmentOptions& line) {
  RelayOptions options;
  options.to = to;
  options.out = options.back = line;
  options.name = "soak";
  return options;
}

struct Usage {
  double resident_mb = 0;
  long descriptors = 0;
};

bool check(bool good, const std::string& what) {
  std::printf("%s: %s\n", good ? "good" : "BAD", what.c_str());
  return good;
}

/// Of all peers the link has and had.
PeerCounters sum_of(const SwitchReport& report, std::size_t link) {
  PeerCounters sum = report.core.departed.at(link);
  for (const PeerStatus& peer : report.core.peers) {
    if (peer.link != link) continue;
    sum = sum + peer.counters;
  }
  return sum;
}

void print(const char* who, const PeerCounters& c) {
  std::printf(
      "%s: chunks %llu, frames %llu, setpoints %llu, forwarded %llu, delivered %llu, "
      "refused %llu\n",
      who, static_cast<unsigned long long>(c.chunks), static_cast<unsigned long long>(c.frames),
      static_cast<unsigned long long>(c.setpoints), static_cast<unsigned long long>(c.forwarded),
      static_cast<unsigned long long>(c.delivered),
      static_cast<unsigned long long>(c.refused_in_all()));
}

/// Everybody but the switch.
struct World {
  explicit World(const RunningSwitch& running, SoakFlight& vehicle)
      : flight(vehicle),
        air(relay_to(running.address(1), poor_radio(0.2))),
        wire(relay_to(running.address(2), poor_stream())),
        companion(air.local(), 191, {0.5, 0.25, 0, 0.1}, 300),
        script(running.address(3), 195, {0.1, -0.3, 0, 0}, 5000),
        ground(wire.local(), 255, SoakGround::Reads::All),
        deaf(wire.local(), 254, SoakGround::Reads::Nothing),
        at_companion(running.address(1), "soak: near", 1000),
        at_script(running.address(3), "soak: far", 1000) {}

  void turn(double now_s) {
    flight.turn(now_s);
    companion.turn(now_s);
    script.turn(now_s);
    ground.turn(now_s);
    deaf.turn(now_s);
    at_companion.turn(now_s);
    at_script.turn(now_s);
    if (cut_.due(now_s) > 0) wire.cut();
  }

  SoakFlight& flight;
  UdpRelay air;
  TcpRelay wire;
  SoakSource companion, script;
  SoakGround ground, deaf;
  SoakHostile at_companion, at_script;

 private:
  Rate cut_{0.5};
};

void turn_until(World& world, double end_s) {
  while (monotonic_s() < end_s) {
    world.turn(monotonic_s());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

int soak(double duration_s) {
  SoakFlight flight(SwitchOptions{}.envelope);
  SwitchLoopOptions options = loopback_switch(flight.local());
  options.core.links[1].flow = {4000, 800};  // ten times what a companion says
  RunningSwitch running(options);
  World world(running, flight);
  const double start_s = monotonic_s();
  // Until every table and buffer has its size: a third of the time, at most 40 s.
  turn_until(world, start_s + std::min(40.0, duration_s / 3));
  const Usage warm{resident_mb(), open_descriptors()};
  Usage most = warm;
  for (double next_s = monotonic_s() + 0.5; next_s < start_s + duration_s; next_s += 0.5) {
    turn_until(world, next_s);
    most.resident_mb = std::max(most.resident_mb, resident_mb());
    most.descriptors = std::max(most.descriptors, open_descriptors());
  }
  running.end();
  flight.turn(monotonic_s());
  const SwitchReport report = running.report();
  const PeerCounters vehicle = sum_of(report, 0);
  const PeerCounters script = sum_of(report, 3);
  print("vehicle", vehicle);
  print("companion", sum_of(report, 1));
  print("script", script);
  std::printf("vehicle heard %ld frames, %ld setpoints, %ld of them moves; longest gap %.3f s\n",
              flight.frames(), flight.setpoints(), flight.moves(), flight.longest_gap_s());
  std::printf(
      "companion sent %ld, script %ld, hostile %ld; ground connected %ld times, read %ld "
      "bytes; %ld events; longest turn of the switch %.1f ms\n",
      world.companion.sent(), world.script.sent(),
      world.at_companion.sent() + world.at_script.sent(), world.ground.connections(),
      world.ground.read_bytes(), running.events(), report.longest_turn_s * 1e3);
  std::printf("bad inputs tried %ld, wrong commands passed %ld\n",
              world.at_companion.sent() + world.at_script.sent(), flight.wrong());
  bool good = check(flight.wrong() == 0, "nothing wrong reached the vehicle");
  good &= check(flight.moves() > long(duration_s * 20), "the companion's commands did");
  good &= check(most.resident_mb < warm.resident_mb + 4,
                "memory " + std::to_string(warm.resident_mb) + " MB warm, at most " +
                    std::to_string(most.resident_mb));
  // Two connections of the ground, both sides of relay and switch, come and go: at most eight.
  good &= check(most.descriptors <= warm.descriptors + 8,
                "descriptors " + std::to_string(warm.descriptors) + " warm, at most " +
                    std::to_string(most.descriptors));
  const std::uint64_t dropped = report.links[0].counts.dropped;
  good &= check(vehicle.delivered <= std::uint64_t(flight.frames()) + dropped &&
                    std::uint64_t(flight.frames()) <= vehicle.delivered + 3,
                "what was given out for the vehicle arrived: " + std::to_string(vehicle.delivered) +
                    " = " + std::to_string(flight.frames()) + " + " + std::to_string(dropped) +
                    " dropped (the last zeros are sent thrice)");
  for (std::size_t link = 0; link < report.core.departed.size(); ++link) {
    const PeerCounters c = sum_of(report, link);
    good &= check(c.frames == c.forwarded + c.kept + c.refused_frames(),
                  "link " + std::to_string(link) + ": " + std::to_string(c.frames) + " frames = " +
                      std::to_string(c.forwarded) + " passed on + " + std::to_string(c.kept) +
                      " kept + " + std::to_string(c.refused_frames()) + " refused");
  }
  good &= check(vehicle.frames == vehicle.chunks, "each datagram of the vehicle was one frame");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace kestrel::test

int main(int argc, char** argv) {
  try {
    return kestrel::test::soak(argc > 1 ? std::stod(argv[1]) : 15);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soak: %s\n", error.what());
    return 2;
  }
}
