#include "kestrel/link/signing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;

const FrameView& view_of(const Parsed& parsed) { return std::get<FrameView>(parsed.content); }

SigningStamp random_stamp(test::Random& random) {
  const std::uint64_t high = std::uint64_t(random.integer(0, 0xFFFF)) << 32;
  return {test::random_byte(random), high | test::random_bits(random)};
}

// Worked out with python3:
//   frame = header + payload + crc, bit by bit from the definition, incompat flag 1
//   stamp = bytes([3]) + (0x102030405060).to_bytes(6, 'little')
//   hashlib.sha256(bytes(range(32)) + frame + stamp).digest()[:6]
TEST(Signing, IsAsTheStandardSays) {
  SigningKey::Secret secret{};
  for (std::size_t i = 0; i < secret.size(); ++i) secret[i] = std::uint8_t(i);
  const SigningKey key(secret);
  const Buffer golden = {0xFD, 0x09, 0x01, 0x00, 0x07, 0x01, 0xBF, 0x00, 0x00, 0x00, 0x00, 0x00,
                         0x00, 0x00, 0x12, 0x08, 0x00, 0x04, 0x03, 0x0A, 0x8C, 0x03, 0x60, 0x50,
                         0x40, 0x30, 0x20, 0x10, 0x0E, 0x80, 0x4D, 0xC0, 0x1C, 0x5C};
  const SigningStamp stamp{3, 0x102030405060};
  EXPECT_EQ(test::copy(signed_frame(Heartbeat{}, {1, 191, 7}, stamp, key).bytes()), golden);
  const Parsed parsed = parse(test::view(golden));
  EXPECT_TRUE(signature_matches(view_of(parsed), key));
  EXPECT_EQ(signing_stamp(view_of(parsed)).link_id, 3);
  EXPECT_EQ(signing_stamp(view_of(parsed)).time, 0x102030405060u);
}

TEST(Signing, KeepsTheMessageAndItsStamp) {
  test::Random random("signing");
  const SigningKey key = random_key();
  for (int i = 0; i < 1000; ++i) {
    const Message message = test::random_message(random);
    const Envelope envelope = test::random_envelope(random);
    const SigningStamp stamp = random_stamp(random);
    const EncodedFrame frame = signed_frame(message, envelope, stamp, key);
    const Parsed parsed = parse(frame.bytes());
    const FrameView& view = view_of(parsed);
    ASSERT_NE(view.info, nullptr);
    EXPECT_TRUE(view.is_signed());
    EXPECT_TRUE(signature_matches(view, key));
    EXPECT_EQ(signing_stamp(view).link_id, stamp.link_id);
    EXPECT_EQ(signing_stamp(view).time, stamp.time);
    EXPECT_EQ(test::fields(std::get<Packet>(decode(frame.bytes()).content).message),
              test::fields(message));
    EXPECT_EQ(test::copy(unsigned_frame(view).bytes()),
              test::copy(encode(message, envelope).bytes()));
  }
}

TEST(Signing, NoticesAnyBitFlipped) {
  test::Random random("signed bit flips");
  const SigningKey key = random_key();
  for (int i = 0; i < 10; ++i) {
    const Buffer frame = test::copy(
        signed_frame(test::random_message(random), {1, 191, 0}, random_stamp(random), key).bytes());
    for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
      Buffer flipped = frame;
      flipped[bit / 8] ^= std::uint8_t(1 << bit % 8);
      // A view has the size that its frame claims: those claims are for parse to judge.
      if (bit / 8 == 1 || bit == 16) continue;
      EXPECT_FALSE(signature_matches({test::view(flipped), nullptr}, key)) << "bit " << bit;
    }
  }
}

TEST(Signing, NoticesAnotherKey) {
  const SigningKey key = random_key();
  const EncodedFrame frame = signed_frame(Heartbeat{}, {}, {}, key);
  const FrameView view{frame.bytes(), nullptr};
  EXPECT_TRUE(signature_matches(view, key));
  EXPECT_FALSE(signature_matches(view, random_key()));
  SigningKey::Secret near{};
  std::copy(key.bytes().begin(), key.bytes().end(), near.begin());
  near[31] ^= 1;
  EXPECT_FALSE(signature_matches(view, SigningKey(near)));
  const EncodedFrame bare = encode(Heartbeat{}, {});
  EXPECT_FALSE(signature_matches({bare.bytes(), nullptr}, key));
  EXPECT_EQ(signing_stamp({bare.bytes(), nullptr}).time, 0u);
}

TEST(Signing, IsReplacedOnTheNextLink) {
  const SigningKey first = random_key();
  const SigningKey second = random_key();
  const EncodedFrame once = signed_frame(SetPositionTarget{}, {1, 191, 9}, {1, 1000}, first);
  const EncodedFrame twice = signed_frame(FrameView{once.bytes(), nullptr}, {2, 2000}, second);
  EXPECT_EQ(test::copy(twice.bytes()),
            test::copy(signed_frame(SetPositionTarget{}, {1, 191, 9}, {2, 2000}, second).bytes()));
}

TEST(Signing, NeedsToKnowNothingOfTheMessage) {
  const SigningKey key = random_key();
  test::Random random("unknown messages");
  for (int i = 0; i < 50; ++i) {
    Buffer payload(std::size_t(random.integer(0, 255)));
    for (std::uint8_t& byte : payload) byte = test::random_byte(random);
    const auto extra = test::random_byte(random);
    const Buffer bare = test::hand_made_frame(120, payload, extra);
    const EncodedFrame frame = signed_frame(FrameView{test::view(bare), nullptr}, {}, key);
    const FrameView view{frame.bytes(), nullptr};
    EXPECT_TRUE(signature_matches(view, key));
    EXPECT_EQ(test::copy(view.bytes.first(frame.size - kSignatureSize)),
              test::hand_made_frame(120, payload, extra, kSigned));
    EXPECT_EQ(test::copy(unsigned_frame(view).bytes()), bare);
  }
}

TEST(Signing, TimeCountsTensOfMicrosecondsSince2015) {
  EXPECT_EQ(signing_time(1420070400), 0u);  // date -u -d 2015-01-01 +%s
  EXPECT_EQ(signing_time(1420070401.25), 125000u);
  EXPECT_EQ(signing_time(1420070400 + 365 * 86400.0), 3153600000000u);
  EXPECT_EQ(signing_time(0), 0u);
  EXPECT_EQ(signing_time(std::numeric_limits<double>::quiet_NaN()), 0u);
  EXPECT_EQ(signing_time(-std::numeric_limits<double>::infinity()), 0u);
  EXPECT_EQ(signing_time(std::numeric_limits<double>::infinity()), kLastSigningTime);
  EXPECT_EQ(signing_time(1e12), kLastSigningTime);
}

TEST(Signing, KeysAreNeverTheSame) {
  EXPECT_NE(test::copy(random_key().bytes()), test::copy(random_key().bytes()));
}

TEST(Signing, AKeyLeavesNothingBehind) {
  alignas(SigningKey) std::array<std::uint8_t, sizeof(SigningKey)> place{};
  SigningKey::Secret secret{};
  secret.fill(0xA5);
  auto* key = new (place.data()) SigningKey(secret);
  EXPECT_EQ(std::count(place.begin(), place.end(), 0xA5), 32);
  key->~SigningKey();
  EXPECT_EQ(std::count(place.begin(), place.end(), 0xA5), 0);
}

}  // namespace
}  // namespace kestrel::mavlink
