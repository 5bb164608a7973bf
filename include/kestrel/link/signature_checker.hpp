#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kestrel/link/frame.hpp"
#include "kestrel/link/signing.hpp"

namespace kestrel::mavlink {

/// What a signature says of its frame.
enum class Verdict {
  Genuine,     // signed with the key, and new
  Unsigned,    // no signature at all
  Forged,      // not signed with the key, or changed since
  Replayed,    // not newer than the last one of its stream
  TooOld,      // signed too long ago
  FromFuture,  // signed too far ahead of the clock here
  NoRoom,      // genuine, but of one stream more than there is room for
};
constexpr std::size_t kVerdicts = 7;

/// "genuine", "unsigned", "forged", "replayed", "too old", "from the future", "no room".
const char* name(Verdict verdict);

/// How far the time of a signature may be behind the clock here (mavlink.io, "Message Signing":
/// one minute for a new stream), and ahead of it. Clocks that differ by more do not understand each
/// other until one is set; see TimestampStore for how far ahead a sender may be of its own clock.
constexpr double kOldestSignature_s = 60;
constexpr double kFarthestAhead_s = 60;

/// Tells which signed frames of one key are genuine and new. In each stream (system, component,
/// link id) the times strictly increase, so that no frame is ever accepted twice. A frame that is
/// refused changes nothing.
///
/// It remembers kStreams streams. When there is no room, a stream is forgotten whose last frame
/// has become too old: whatever it sent would be refused for its age, and should the clock be set
/// back, nothing up to the time of that frame is accepted of any new stream. Else the new stream is
/// refused: only holders of the key can get so far, and they cannot displace each other.
class SignatureChecker {
 public:
  static constexpr std::size_t kStreams = 64;

  /// Nothing signed at `floor` (see signing_time) or before is accepted. At a start give it the time
  /// of the start, or newest() from before it if that was kept: with 0, what was sent within the
  /// last minute before a restart could be sent again.
  explicit SignatureChecker(const SigningKey& key, std::uint64_t floor = 0)
      : key_(key), floor_(floor), newest_(floor) {}

  /// The verdict on a frame that is received at unix_s, seconds since 1970 on the clock here.
  Verdict check(const FrameView& frame, double unix_s);

  /// The latest time of a frame accepted, or the floor.
  std::uint64_t newest() const { return newest_; }

 private:
  struct Stream {
    std::uint8_t system_id = 0, component_id = 0, link_id = 0;
    std::uint64_t last = 0;  // signing time of the last frame accepted

    bool is_same(const Stream& other) const {
      return system_id == other.system_id && component_id == other.component_id &&
             link_id == other.link_id;
    }
  };

  Verdict accept_in_its_stream(const Stream& stream, std::uint64_t oldest);
  Verdict accept_new(const Stream& stream, std::uint64_t oldest);

  SigningKey key_;
  std::uint64_t floor_ = 0;
  std::uint64_t newest_ = 0;
  std::array<Stream, kStreams> streams_{};
  std::size_t count_ = 0;
};

}  // namespace kestrel::mavlink
