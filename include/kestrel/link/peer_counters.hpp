#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/signature_checker.hpp"

namespace kestrel {

/// A connection, or one sender of datagrams: a number that the one with the sockets gives, and
/// never gives again.
using PeerId = std::uint32_t;

/// Why a frame of a peer was not passed on.
enum class Refused {
  BadMagic,             // no frame starts there
  Truncated,            // the bytes end within a frame
  BadCrc,               // damaged
  UnknownIncompatFlag,  // asks for what is not supported
  TooFast,              // beyond the peer's rate: not even read
  Unsigned,             // the link has a key and the frame no signature
  BadSignature,         // forged, tampered, or another key
  Replayed,             // signed, but its timestamp was used, or lies outside the window
  NoSource,             // from system 0
  OwnIds,               // claims to come from the switch itself
  VehicleIds,           // claims to come from the vehicle, on a link that is not flight control's
  IdsTaken,             // claims the ids of a live component behind a link of another role
  NotForwarded,         // never goes from one link to another (SETUP_SIGNING)
  NotAllowed,           // this role may not send it to flight control
  NotFinite,            // a float is NaN, infinite or, in a setpoint, denormal
  Unsupported,          // a setpoint of another frame or type mask
  Duplicate,            // was here before, by its sequence number
  Late,                 // overtaken by a newer one, by sequence or by capture time
  Stale,                // captured longer ago than the time to live
  FromTheFuture,        // captured later than the sender's clock can say
  NotOwner,             // another source has control
  Locked,               // control is locked, or taken over by the ground
  Stopped,              // the emergency stop is set
  Dead,                 // no heartbeat of its source
  TooManySources,       // no room to tell one more source of commands apart
};
constexpr std::size_t kRefusedReasons = 25;

/// Words for a log or a status page: "bad crc", "not owner".
const char* name(Refused reason);

/// The same reason in the switch's words.
Refused refused_for(mavlink::Refusal refusal);
std::optional<Refused> refused_for(mavlink::Verdict verdict);  // empty for Genuine

/// What became of all that a peer sent, and what was sent to it. Of fixed size, whatever arrives. A
/// frame that was passed on to somebody and refused to flight control, to which it was addressed,
/// counts as refused.
struct PeerCounters {
  std::uint64_t chunks = 0;     // datagrams, or pieces of a stream
  std::uint64_t bytes = 0;      // in them
  std::uint64_t frames = 0;     // intact frames read
  std::uint64_t setpoints = 0;  // of these, setpoints that were accepted
  std::uint64_t forwarded = 0;  // of these, passed on to one peer or more
  std::uint64_t kept = 0;       // of these, neither: for the switch itself, or for nobody
  std::uint64_t delivered = 0;  // frames given out for the peer
  std::array<std::uint64_t, kRefusedReasons> refused{};

  std::uint64_t refused_as(Refused reason) const { return refused[std::size_t(reason)]; }
  std::uint64_t refused_in_all() const;
  /// Of these, intact frames: frames = forwarded + kept + refused_frames().
  std::uint64_t refused_frames() const;
};

/// What became of what both sent.
PeerCounters operator+(const PeerCounters& a, const PeerCounters& b);

}  // namespace kestrel
