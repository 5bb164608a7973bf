#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "kestrel/link/bytes.hpp"
#include "kestrel/link/frame.hpp"

namespace kestrel::mavlink {

/// The frames of a stream of bytes (TCP, a serial line) in which chunks end anywhere. Read it by
///     for (Bytes rest = chunk; rest.size > 0;) {
///       rest = parser.push(rest);
///       while (const auto parsed = parser.next()) ...
///     }
/// which always ends, whatever the bytes. Which frames come out depends on the bytes alone, not on
/// how they are cut. After any failure the search goes on behind the mark that failed, so that no
/// intact frame is lost to a damaged one or to garbage.
///
/// A frame of an unknown message cannot be checked. It is believed when it starts right behind an
/// intact frame (or at the start of the stream) and the mark of another follows it; it is told when
/// that mark is there. Nothing is looked for inside of it: such messages carry files and logs,
/// which hold frames of the past. So of a peer whose garbage poses as such a frame, the up to 279
/// bytes that it claims are lost.
///
/// A false mark holds up what stands behind it until the bytes it claims have come, at most
/// kMaxFrame and one more; the next bytes of the peer undo that, and a peer that stays silent has
/// sent nothing in time anyhow. Behind garbage a claim to an unknown message holds up ten bytes
/// only.
class StreamParser {
 public:
  /// Takes what there is room for and returns the rest: nothing of a chunk when next() was not
  /// asked until it was empty, and never nothing when it was. Views given before are void.
  Bytes push(Bytes chunk);

  /// The next frame, or why some bytes are passed over and how many (a run of garbage may be told
  /// in pieces); empty when more bytes are needed. Views live until the next push.
  std::optional<Parsed> next();

 private:
  static constexpr std::size_t kRoom = 4096;

  Bytes pending() const { return {buffer_.data() + start_, end_ - start_}; }
  Parsed taken(const Parsed& parsed);
  Parsed passed_over(Refusal reason, std::size_t claimed);

  std::array<std::uint8_t, kRoom> buffer_{};
  std::size_t start_ = 0, end_ = 0;
  bool in_step_ = true;  // what is pending starts where a frame ended
};

}  // namespace kestrel::mavlink
