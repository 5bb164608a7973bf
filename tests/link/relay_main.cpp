// A bad line between two programs, as a program:
//   relay udp|tcp LISTEN TO [OPTION=VALUE ...]     LISTEN, TO: 127.0.0.1:5005 or [::1]:5005
// OPTION: those of ImpairmentOptions, both ways; with "out." or "back." before it, one way; "name",
// the seed; "duration_s", without end otherwise. Prints where it listens, and at the end the
// counts.
#include <csignal>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "link/tcp_relay.hpp"
#include "link/udp_relay.hpp"

namespace kestrel::test {
namespace {

volatile std::sig_atomic_t interrupted = 0;
extern "C" void note_end(int) { interrupted = 1; }

double& option(ImpairmentOptions& options, const std::string& name) {
  static const std::map<std::string, double ImpairmentOptions::*> kOptions = {
      {"loss", &ImpairmentOptions::loss},
      {"duplication", &ImpairmentOptions::duplication},
      {"corruption", &ImpairmentOptions::corruption},
      {"truncation", &ImpairmentOptions::truncation},
      {"reordering", &ImpairmentOptions::reordering},
      {"splitting", &ImpairmentOptions::splitting},
      {"delay_s", &ImpairmentOptions::delay_s},
      {"jitter_s", &ImpairmentOptions::jitter_s},
      {"holdback_s", &ImpairmentOptions::holdback_s},
      {"retransmission_s", &ImpairmentOptions::retransmission_s},
      {"bandwidth_bytes_s", &ImpairmentOptions::bandwidth_bytes_s},
      {"queue_s", &ImpairmentOptions::queue_s}};
  const auto found = kOptions.find(name);
  if (found == kOptions.end()) throw std::invalid_argument("unknown option " + name);
  return options.*found->second;
}

struct Arguments {
  bool stream = false;
  RelayOptions relay;
  double duration_s = 1e18;
};

void read_option(Arguments& a, const std::string& word) {
  const auto equals = word.find('=');
  if (equals == std::string::npos) throw std::invalid_argument("not OPTION=VALUE: " + word);
  const std::string name = word.substr(0, equals);
  const std::string value = word.substr(equals + 1);
  if (name == "name") {
    a.relay.name = value;
  } else if (name == "duration_s") {
    a.duration_s = std::stod(value);
  } else if (name.rfind("out.", 0) == 0) {
    option(a.relay.out, name.substr(4)) = std::stod(value);
  } else if (name.rfind("back.", 0) == 0) {
    option(a.relay.back, name.substr(5)) = std::stod(value);
  } else {
    option(a.relay.out, name) = option(a.relay.back, name) = std::stod(value);
  }
}

Arguments read_arguments(const std::vector<std::string>& words) {
  if (words.size() < 3 || (words[0] != "udp" && words[0] != "tcp")) {
    throw std::invalid_argument("usage: relay udp|tcp LISTEN TO [OPTION=VALUE ...]");
  }
  Arguments a;
  a.stream = words[0] == "tcp";
  a.relay.listen = parse_address("udp://" + words[1]);
  a.relay.to = parse_address("udp://" + words[2]);
  for (std::size_t i = 3; i < words.size(); ++i) read_option(a, words[i]);
  return a;
}

void print(const char* way, const LineCounts& c) {
  std::printf(
      "%s: sent %ld, lost %ld, overflowed %ld, duplicated %ld, corrupted %ld, truncated "
      "%ld, reordered %ld, split %ld, delivered %ld\n",
      way, c.sent, c.lost, c.overflowed, c.duplicated, c.corrupted, c.truncated, c.reordered,
      c.split, c.delivered);
}

template <class Relay>
void relay(const Arguments& a) {
  const Relay running(a.relay);
  std::printf("listening on %s\n", to_string(running.local()).substr(6).c_str());
  std::fflush(stdout);
  const double end_s = monotonic_s() + a.duration_s;
  std::vector<pollfd> nothing;
  while (interrupted == 0 && monotonic_s() < end_s) wait_ready(nothing, monotonic_s() + 0.1);
  print("out", running.counts().out);
  print("back", running.counts().back);
}

}  // namespace
}  // namespace kestrel::test

int main(int argc, char** argv) {
  try {
    const auto arguments = kestrel::test::read_arguments({argv + 1, argv + argc});
    std::signal(SIGINT, kestrel::test::note_end);
    std::signal(SIGTERM, kestrel::test::note_end);
    if (arguments.stream) {
      kestrel::test::relay<kestrel::test::TcpRelay>(arguments);
    } else {
      kestrel::test::relay<kestrel::test::UdpRelay>(arguments);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "relay: %s\n", error.what());
    return 2;
  }
}
