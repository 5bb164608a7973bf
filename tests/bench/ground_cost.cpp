// What the ground station costs the loop, how old the pictures are that it shows, and how long an
// abort takes to the wire. The real program flies the simulator on core 0, all else is on core 1;
// with and without viewers by turns in one flight, so read the ratios: the times are the machine's.
//
//   build/<preset>/ground_cost [turns]
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include <sched.h>

#include <nlohmann/json.hpp>

#include "kestrel/ground/access_token.hpp"
#include "kestrel/ground/replay_run.hpp"
#include "kestrel/io/run_log.hpp"
#include "kestrel/link/key_file.hpp"

#include "bench/ground_viewers.hpp"
#include "cli/program.hpp"
#include "cli/wire_listener.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::bench {
namespace {

using Json = nlohmann::json;

constexpr double kTurn_s = 4;
constexpr double kSettle_s = 0.5;  // of each turn: viewers come and go
constexpr int kAborts = 20;

using test::now_s;

void nap(double s) { std::this_thread::sleep_for(std::chrono::duration<double>(s)); }

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::size_t(share * double(values.size() - 1))];
}

/// Part of the flight, by the stamps of its frames.
struct Turn {
  double from_s = 0;
  double to_s = 0;
};

/// How old each frame was when it was there, s, against the youngest that any viewer saw.
class Ages {
 public:
  void note(const StreamFrame& frame) {
    const Json words = Json::parse(frame.json);
    if (!words.contains("view")) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    all_.push_back(now_s() - words["view"]["stamp_s"].get<double>());
  }
  double least() const { return quantile(all_, 0); }
  double most() const { return quantile(all_, 1); }
  double median() const { return quantile(all_, 0.5); }
  std::size_t frames() const { return all_.size(); }

 private:
  std::mutex mutex_;
  std::vector<double> all_;
};

class Flight {
 public:
  explicit Flight(int port) : port_(port) {
    const mavlink::SigningKey key = mavlink::random_key();
    mavlink::write_key(folder_ / "token", key);
    bearer_ = "Bearer " + AccessToken(key).text();
    program_ = std::make_unique<test::Program>(
        test::Command{{"taskset", "-c", "0", KESTREL_PROGRAM, "simulate",
                       KESTREL_SOURCE_DIR "/tasks/hover.yaml", "--ground", std::to_string(port_),
                       "--ground-token", "token", "--sink", wire_.url(), "--no-video", "--duration",
                       "3600", "--output", "run"}},
        folder_.path());
    while (give({{"do", "join"}}).empty()) nap(0.1);
    client_ = Json::parse(give({{"do", "join"}}))["client"];
    command("take");
    alive_ = std::thread([this] {
      while (!done_) {
        command("alive");
        nap(0.5);
      }
    });
  }
  ~Flight() {
    done_ = true;
    alive_.join();
  }
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  void command(const char* word) {
    const std::lock_guard<std::mutex> lock(mutex_);
    give({{"do", word}, {"client", client_}, {"number", ++number_}});
  }
  void abort() { give({{"do", "abort"}}); }
  std::unique_ptr<Viewer> viewer(const Appetite& appetite, Ages* ages) {
    return std::make_unique<Viewer>(port_, bearer_, appetite, [ages](const StreamFrame& frame) {
      if (ages != nullptr) ages->note(frame);
    });
  }
  const test::WireListener& wire() const { return wire_; }

  /// Flies on for a turn.
  Turn turn() {
    nap(kSettle_s);
    Turn turn{wire_.stamp_s(), 0};
    nap(kTurn_s - kSettle_s);
    turn.to_s = wire_.stamp_s();
    return turn;
  }

  /// The chain's times by the stamps of the frames, ms.
  std::map<double, double> land() {
    program_->signal(SIGINT);
    program_->wait();
    const LogFile log = read_log(folder_ / "run" / "run.csv");
    const auto times_ms = chain_times_ms(folder_ / "run" / "timing.csv", log);
    std::map<double, double> by_stamp;
    for (std::size_t i = 0; i < log.rows.size(); ++i) {
      by_stamp[log.rows[i].stamp_s] = times_ms[i];
    }
    return by_stamp;
  }

 private:
  std::string give(const Json& command) {
    httplib::Client client("127.0.0.1", port_ + 1);
    const auto answer =
        client.Post("/command", {{"Authorization", bearer_}}, command.dump(), "application/json");
    return answer ? answer->body : "";
  }

  const int port_;
  const test::TempFolder folder_;
  test::WireListener wire_;
  std::string bearer_;
  std::string client_;
  std::unique_ptr<test::Program> program_;
  std::mutex mutex_;
  std::uint64_t number_ = 0;
  std::atomic<bool> done_{false};
  std::thread alive_;
};

double p95_ms(const std::map<double, double>& times_ms, const Turn& turn) {
  std::vector<double> within;
  for (auto it = times_ms.lower_bound(turn.from_s); it != times_ms.end() && it->first < turn.to_s;
       ++it) {
    within.push_back(it->second);
  }
  return quantile(within, 0.95);
}

/// Without viewers and with, one after the other.
struct Pair {
  Turn without;
  Turn with;
};

void print_ratios(const char* what, const std::map<double, double>& times_ms,
                  const std::vector<Pair>& pairs) {
  std::vector<double> ratios;
  for (const Pair& pair : pairs) {
    ratios.push_back(p95_ms(times_ms, pair.with) / p95_ms(times_ms, pair.without));
  }
  std::printf("%-44s p95 of the chain x %.3f in the median of %zu pairs (%.3f to %.3f)\n", what,
              quantile(ratios, 0.5), ratios.size(), quantile(ratios, 0), quantile(ratios, 1));
}

void print_ages(const char* what, const Ages& ages, double youngest) {
  std::printf("%-44s %4zu frames, %.2f s old in the median, %.2f s at most\n", what, ages.frames(),
              ages.median() - youngest, ages.most() - youngest);
}

void measure_aborts(Flight& flight) {
  std::vector<std::unique_ptr<Viewer>> six;
  for (int i = 0; i < 6; ++i) six.push_back(flight.viewer({}, nullptr));
  std::vector<double> taken_ms;
  for (int i = 0; i < kAborts; ++i) {
    flight.command("reset");
    flight.command("start");
    for (int k = 0; k < 200 && flight.wire().speed() == 0; ++k) nap(0.01);
    if (flight.wire().speed() == 0) continue;  // not in sight just now
    nap(0.003 * i);                            // anywhere between two frames
    const double asked_s = now_s();
    flight.abort();
    nap(0.1);
    taken_ms.push_back((flight.wire().stopped_s() - asked_s) * 1e3);
  }
  std::printf("%-44s %.1f ms in the median, %.1f ms at most, of %zu\n",
              "abort to zero on the wire, six streams open", quantile(taken_ms, 0.5),
              quantile(taken_ms, 1), taken_ms.size());
}

void measure(int turns) {
  Flight flight(20000 + int(getpid() % 3000) * 4);
  flight.command("start");
  nap(2);
  std::vector<Pair> three;
  std::vector<Pair> bad;
  Ages slow;
  Ages fast;
  for (int i = 0; i < turns; ++i) {
    const Turn without = flight.turn();
    {
      std::vector<std::unique_ptr<Viewer>> viewers;
      for (int k = 0; k < 3; ++k) viewers.push_back(flight.viewer({}, nullptr));
      three.push_back({without, flight.turn()});
    }
    const Turn again = flight.turn();
    const auto eager = flight.viewer({}, &fast);
    const auto stuck = flight.viewer({0, false}, nullptr);
    const auto throttled = flight.viewer({300e3, true}, &slow);
    bad.push_back({again, flight.turn()});
  }
  measure_aborts(flight);
  const auto times_ms = flight.land();
  std::printf("p95 of the chain without viewers: %.2f ms\n", p95_ms(times_ms, three[0].without));
  print_ratios("three viewers at the full rate", times_ms, three);
  print_ratios("a stuck one, one at 300 kB/s, one fast", times_ms, bad);
  print_ages("the fast one beside them", fast, fast.least());
  print_ages("the one at 300 kB/s", slow, fast.least());
}

}  // namespace
}  // namespace kestrel::bench

int main(int argc, char** argv) {
  cpu_set_t other;
  CPU_ZERO(&other);
  CPU_SET(1, &other);
  sched_setaffinity(0, sizeof other, &other);
  kestrel::bench::measure(argc > 1 ? std::max(1, std::atoi(argv[1])) : 10);
  return 0;
}
