#include "kestrel/link/peer_counters.hpp"

#include <numeric>

namespace kestrel {

const char* name(Refused reason) {
  constexpr std::array<const char*, kRefusedReasons> kNames = {
      "bad magic",        "truncated",   "bad crc",       "unknown incompat flag",
      "too fast",         "unsigned",    "bad signature", "replayed",
      "no source",        "own ids",     "vehicle ids",   "ids taken",
      "not forwarded",    "not allowed", "not finite",    "unsupported",
      "duplicate",        "late",        "stale",         "from the future",
      "not owner",        "locked",      "stopped",       "dead",
      "too many sources", "cannot sign"};
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
      return Refused::UnknownIncompatFlag;
    case mavlink::Refusal::UnknownMessage:
      return Refused::NotAllowed;
  }
  return Refused::NotAllowed;
}

std::uint64_t PeerCounters::refused_in_all() const {
  return std::accumulate(refused.begin(), refused.end(), std::uint64_t{0});
}

}  // namespace kestrel
