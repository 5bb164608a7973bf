#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "kestrel/link/time_messages.hpp"

namespace kestrel {

/// Another clock against ours.
struct ClockEstimate {
  double offset_s = 0;      // their clock minus ours
  double round_trip_s = 0;  // of the exchange it rests on
  double error_s = 0;       // the offset is wrong by at most this

  double to_ours(double theirs_s) const { return theirs_s - offset_s; }
  double to_theirs(double ours_s) const { return ours_s + offset_s; }
};

struct ClockSyncOptions {
  double window_s = 30;           // exchanges older than this are forgotten
  double patience_s = 2;          // an answer that comes later is not used
  double drift_s_per_s = 100e-6;  // by how much two crystals may part: 50 ppm each

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What became of an answer.
enum class ClockAnswer {
  Used,
  NotAsked,  // it mirrors no open question of ours, or comes too late
  Jumped,    // used: their clock has jumped (a reboot), what was known before is forgotten
};

/// The offset of another clock by MAVLink's TIMESYNC. An answer that left at their time t, to a
/// question asked at our time a and answered here at b, bounds the offset to t - (a + b) / 2 within
/// (b - a) / 2 however the delay is shared between the two ways (Cristian 1989, "Probabilistic
/// clock synchronization"). Of the exchanges in the window the one with the least bound counts, the
/// bound of each growing by the drift: jitter makes others worse, not this one.
class ClockSync {
 public:
  /// Throws as ClockSyncOptions::check.
  explicit ClockSync(const ClockSyncOptions& options = {});

  /// A question to be sent now. At most kMaxOpen are open, the oldest is given up.
  mavlink::TimeSync ask(double now_s);

  /// An answer that arrives now; each question takes one.
  ClockAnswer take(const mavlink::TimeSync& answer, double now_s);

  /// Empty before the first answer, and when the last is older than the window.
  std::optional<ClockEstimate> estimate(double now_s) const;

  /// How often their clock has jumped.
  long jumps() const { return jumps_; }

  static constexpr std::size_t kMaxOpen = 16;
  static constexpr std::size_t kMaxExchanges = 64;

 private:
  struct Exchange {
    double offset_s;
    double round_trip_s;
    double at_s;
  };
  ClockEstimate estimate_by(const Exchange& exchange, double now_s) const;

  ClockSyncOptions options_;
  std::deque<std::int64_t> open_ns_;
  std::deque<Exchange> exchanges_;
  long jumps_ = 0;
};

/// The answer to a question at now_s; empty for what is itself an answer, or for somebody else
/// (not for `system_id`, `component_id`; 0 in the question is everybody).
std::optional<mavlink::TimeSync> time_answer(const mavlink::TimeSync& question,
                                             std::uint8_t system_id, std::uint8_t component_id,
                                             double now_s);

}  // namespace kestrel
