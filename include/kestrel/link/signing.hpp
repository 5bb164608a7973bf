#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kestrel/link/bytes.hpp"
#include "kestrel/link/frame.hpp"
#include "kestrel/link/message.hpp"

// Signatures of MAVLink 2 frames (mavlink.io, "Message Signing"): they say that a frame comes from
// one who holds the key, and when it was signed. The frame itself is not secret.
namespace kestrel::mavlink {

/// A secret shared by those who may speak to each other. Its bytes are wiped where it ends; it has
/// no way to be printed.
class SigningKey {
 public:
  static constexpr std::size_t kSize = 32;
  using Secret = std::array<std::uint8_t, kSize>;

  explicit SigningKey(const Secret& secret) : secret_(secret) {}
  ~SigningKey();
  SigningKey(const SigningKey&) = default;
  SigningKey& operator=(const SigningKey&) = default;

  Bytes bytes() const { return {secret_.data(), secret_.size()}; }

 private:
  Secret secret_;
};

/// A key that nobody can guess, from the random numbers of the kernel. Throws std::runtime_error
/// when it has none to give.
SigningKey random_key();

/// Units of a signing time in a second, and the largest that a frame has room for (48 bits).
constexpr double kSigningUnits_per_s = 1e5;
constexpr std::uint64_t kLastSigningTime = (std::uint64_t{1} << 48) - 1;

/// Tens of microseconds since 2015-01-01 UTC at a time in seconds since 1970; 0 before, and for
/// what is no number; kLastSigningTime in the year 2104 and after.
std::uint64_t signing_time(double unix_s);

/// What a signature says of its frame besides that it is genuine.
struct SigningStamp {
  std::uint8_t link_id = 0;  // which of the sender's links it was sent on
  std::uint64_t time = 0;    // see signing_time
};

/// The frame of a message, signed.
EncodedFrame signed_frame(const Message& message, const Envelope& envelope,
                          const SigningStamp& stamp, const SigningKey& key);

/// Somebody's frame, signed anew: a signature it has is replaced. Unknown messages are signed too.
EncodedFrame signed_frame(const FrameView& frame, const SigningStamp& stamp, const SigningKey& key);

/// The frame without its signature.
EncodedFrame unsigned_frame(const FrameView& frame);

/// What stands in the signature of a signed frame; zeros for one that is not signed.
SigningStamp signing_stamp(const FrameView& frame);

/// True when the frame is signed with that key. Takes the same time wherever a signature is wrong.
/// That a frame is genuine does not make it new: see SignatureChecker.
bool signature_matches(const FrameView& frame, const SigningKey& key);

}  // namespace kestrel::mavlink
