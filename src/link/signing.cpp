#include "kestrel/link/signing.hpp"

#include <algorithm>
#include <stdexcept>

#include <sodium.h>

#include "kestrel/link/crc.hpp"

namespace kestrel::mavlink {
namespace {

constexpr double kSigningStart_s = 1420070400;  // 2015-01-01 00:00:00 UTC, since 1970
constexpr std::size_t kIncompat = 2;            // place in the header
constexpr std::size_t kTimeSize = 6;
constexpr std::size_t kStampSize = 1 + kTimeSize;
constexpr std::size_t kDigestSize = kSignatureSize - kStampSize;

using Digest = std::array<std::uint8_t, crypto_hash_sha256_BYTES>;

/// SHA-256 of the key and all of the frame but the signature's last six bytes, of which they are
/// the first six.
Digest digest_of(Bytes frame_and_stamp, const SigningKey& key) {
  crypto_hash_sha256_state state;
  Digest digest{};
  crypto_hash_sha256_init(&state);
  crypto_hash_sha256_update(&state, key.bytes().data, key.bytes().size);
  crypto_hash_sha256_update(&state, frame_and_stamp.data, frame_and_stamp.size);
  crypto_hash_sha256_final(&state, digest.data());
  sodium_memzero(&state, sizeof state);
  return digest;
}

/// The frame without its signature, and with that flag. A checksum is linear: those of two frames
/// that differ in one bit differ by the checksum, from 0 on, of that bit and what stands behind it,
/// whatever the message's CRC_EXTRA is. So nothing needs to be known of the message, and a wrong
/// checksum stays wrong.
EncodedFrame with_signed_flag(const FrameView& frame, std::uint8_t flag) {
  const std::size_t size = frame.bytes.size - frame.signature().size;
  EncodedFrame changed;
  std::copy_n(frame.bytes.data, size, changed.data.begin());
  changed.size = size;
  const auto flipped = std::uint8_t((frame.bytes.data[kIncompat] & kSigned) ^ flag);
  changed.data[kIncompat] ^= flipped;
  std::uint16_t difference = crc_add(std::uint16_t{0}, flipped);
  // Behind it the rest of the header, the payload and CRC_EXTRA.
  for (std::size_t i = kIncompat + 1; i < size - kCrcSize + 1; ++i) {
    difference = crc_add(difference, std::uint8_t{0});
  }
  changed.data[size - 2] ^= std::uint8_t(difference);
  changed.data[size - 1] ^= std::uint8_t(difference >> 8);
  return changed;
}

}  // namespace

SigningKey::~SigningKey() { sodium_memzero(secret_.data(), secret_.size()); }

SigningKey random_key() {
  if (sodium_init() < 0) throw std::runtime_error("the system has no random numbers to give");
  SigningKey::Secret secret{};
  randombytes_buf(secret.data(), secret.size());
  const SigningKey key(secret);
  sodium_memzero(secret.data(), secret.size());
  return key;
}

std::uint64_t signing_time(double unix_s) {
  const double units = (unix_s - kSigningStart_s) * kSigningUnits_per_s;
  if (!(units > 0)) return 0;
  return units < double(kLastSigningTime) ? std::uint64_t(units) : kLastSigningTime;
}

EncodedFrame signed_frame(const Message& message, const Envelope& envelope,
                          const SigningStamp& stamp, const SigningKey& key) {
  return signed_frame(FrameView{encode(message, envelope).bytes(), nullptr}, stamp, key);
}

EncodedFrame signed_frame(const FrameView& frame, const SigningStamp& stamp,
                          const SigningKey& key) {
  EncodedFrame result = with_signed_flag(frame, kSigned);
  result.data[result.size++] = stamp.link_id;
  for (std::size_t i = 0; i < kTimeSize; ++i) {
    result.data[result.size++] = std::uint8_t(stamp.time >> (8 * i));
  }
  const Digest digest = digest_of(result.bytes(), key);
  for (std::size_t i = 0; i < kDigestSize; ++i) result.data[result.size++] = digest[i];
  return result;
}

EncodedFrame unsigned_frame(const FrameView& frame) { return with_signed_flag(frame, 0); }

SigningStamp signing_stamp(const FrameView& frame) {
  SigningStamp stamp;
  const Bytes signature = frame.signature();
  if (signature.size < kSignatureSize) return stamp;
  stamp.link_id = signature.data[0];
  for (std::size_t i = 0; i < kTimeSize; ++i) {
    stamp.time |= std::uint64_t(signature.data[1 + i]) << (8 * i);
  }
  return stamp;
}

bool signature_matches(const FrameView& frame, const SigningKey& key) {
  const Bytes signature = frame.signature();
  if (!frame.is_signed() || signature.size != kSignatureSize) return false;
  const Digest digest = digest_of(frame.bytes.first(frame.bytes.size - kDigestSize), key);
  return sodium_memcmp(digest.data(), signature.after(kStampSize).data, kDigestSize) == 0;
}

}  // namespace kestrel::mavlink
