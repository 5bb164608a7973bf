#include "kestrel/link/peer_counters.hpp"

#include <numeric>

namespace kestrel {

const char* name(Refused reason) {
  constexpr std::array<const char*, kRefusedReasons> kNames = {
      "bad magic",       "truncated",   "bad crc",       "unknown incompat flag",
      "too fast",        "unsigned",    "bad signature", "replayed",
      "no source",       "own ids",     "vehicle ids",   "ids taken",
      "not forwarded",   "not allowed", "not finite",    "unsupported",
      "duplicate",       "late",        "stale",         "from the future",
      "not owner",       "locked",      "stopped",       "dead",
      "too many sources"};
  return kNames[std::size_t(reason)];
}

Refused refused_for(mavlink::Refusal refusal) {
  switch (refusal) {
    case mavlink::Refusal::BadMagic:
      return Refused::BadMagic;
    case mavlink::Refusal::Truncated:
      return Refused::Truncated;
    case mavlink::Refusal::BadCrc:
      return Refused::BadCrc;
    case mavlink::Refusal::UnknownIncompatFlag:
    case mavlink::Refusal::UnknownMessage:  // with a flag, else it is a frame
      return Refused::UnknownIncompatFlag;
  }
  return Refused::BadMagic;
}

std::optional<Refused> refused_for(mavlink::Verdict verdict) {
  switch (verdict) {
    case mavlink::Verdict::Genuine:
      return std::nullopt;
    case mavlink::Verdict::Unsigned:
      return Refused::Unsigned;
    case mavlink::Verdict::Forged:
      return Refused::BadSignature;
    case mavlink::Verdict::Replayed:
    case mavlink::Verdict::TooOld:
    case mavlink::Verdict::FromFuture:
      return Refused::Replayed;
    case mavlink::Verdict::NoRoom:
      return Refused::TooManySources;
  }
  return Refused::BadSignature;
}

std::uint64_t PeerCounters::refused_in_all() const {
  return std::accumulate(refused.begin(), refused.end(), std::uint64_t{0});
}

std::uint64_t PeerCounters::refused_frames() const {
  std::uint64_t broken = 0;
  for (const Refused reason : {Refused::BadMagic, Refused::Truncated, Refused::BadCrc,
                               Refused::UnknownIncompatFlag, Refused::TooFast}) {
    broken += refused_as(reason);
  }
  return refused_in_all() - broken;
}

PeerCounters operator+(const PeerCounters& a, const PeerCounters& b) {
  PeerCounters sum = a;
  sum.chunks += b.chunks;
  sum.bytes += b.bytes;
  sum.frames += b.frames;
  sum.setpoints += b.setpoints;
  sum.forwarded += b.forwarded;
  sum.kept += b.kept;
  sum.delivered += b.delivered;
  for (std::size_t i = 0; i < kRefusedReasons; ++i) sum.refused[i] += b.refused[i];
  return sum;
}

}  // namespace kestrel
