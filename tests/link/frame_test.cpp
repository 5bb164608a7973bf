#include "kestrel/link/frame.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;
using test::contents;
using test::Contents;
using test::fields;
using testing::ElementsAre;

TEST(Frame, RoundTripsBitForBit) {
  test::Random random("round trip");
  for (int i = 0; i < 3000; ++i) {
    const Message message = test::random_message(random);
    const Envelope envelope = test::random_envelope(random);
    const Decoded decoded = decode(encode(message, envelope).bytes());
    const auto* packet = std::get_if<Packet>(&decoded.content);
    ASSERT_NE(packet, nullptr);
    EXPECT_EQ(packet->message.index(), message.index());
    EXPECT_EQ(fields(packet->message), fields(message));
    EXPECT_EQ(packet->envelope.system_id, envelope.system_id);
    EXPECT_EQ(packet->envelope.component_id, envelope.component_id);
    EXPECT_EQ(packet->envelope.sequence, envelope.sequence);
    EXPECT_EQ(decoded.size, encode(message, envelope).size);
  }
}

TEST(Frame, KeepsTheBitsOfNanAndInfinity) {
  SetPositionTarget setpoint;
  setpoint.x_m = std::numeric_limits<float>::infinity();
  setpoint.yaw_rad = test::float_of(0x7FC12345);
  setpoint.vx_m_s = -std::numeric_limits<float>::infinity();
  const Decoded decoded = decode(encode(setpoint, {}).bytes());
  EXPECT_EQ(fields(std::get<Packet>(decoded.content).message), fields(setpoint));
}

// Worked out by hand from the definition of the wire, and given by node-mavlink as well.
TEST(Frame, IsWrittenAsTheStandardSays) {
  EXPECT_THAT(
      test::copy(encode(Heartbeat{}, {1, 191, 7}).bytes()),
      ElementsAre(0xFD, 9, 0, 0, 7, 1, 191, 0, 0, 0, 0, 0, 0, 0, 18, 8, 0, 4, 3, 0xED, 0x74));
  SetPositionTarget s;
  s.time_boot_ms = 123456;
  s.vx_m_s = 0.5F;
  s.vy_m_s = -0.25F;
  s.vz_m_s = 0.125F;
  s.yaw_rate_rad_s = -0.0625F;
  s.type_mask = 0x5C7;
  s.target_system = 1;
  s.target_component = 1;
  s.coordinate_frame = 8;
  const Buffer golden = {0xFD, 0x35, 0x00, 0x00, 0xC8, 0x01, 0xBF, 0x54, 0x00, 0x00, 0x40,
                         0xE2, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                         0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x3F, 0x00, 0x00, 0x80,
                         0xBE, 0x00, 0x00, 0x00, 0x3E, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                         0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                         0x00, 0x80, 0xBD, 0xC7, 0x05, 0x01, 0x01, 0x08, 0x22, 0x55};
  EXPECT_EQ(test::copy(encode(s, {1, 191, 200}).bytes()), golden);
}

TEST(Frame, TrimsTrailingZerosButNeverTheFirstByte) {
  EXPECT_EQ(encode(SetPositionTarget{}, {}).data[1], 1);
  EXPECT_EQ(encode(SetPositionTarget{}, {}).size, 13u);
  test::Random random("trimming");
  for (int i = 0; i < 300; ++i) {
    const Buffer frame = test::random_frame(random);
    EXPECT_EQ(frame.size(), std::size_t(12 + frame[1]));
    EXPECT_TRUE(frame[1] == 1 || frame[frame.size() - 3] != 0);
  }
}

TEST(Frame, IsReadWithAnyOfItsTrailingZeros) {
  test::Random random("untrimmed");
  for (int i = 0; i < 100; ++i) {
    const SetPositionTarget setpoint = test::random_setpoint(random);
    const Buffer frame = test::copy(encode(setpoint, {1, 191, 0}).bytes());
    Buffer payload(frame.begin() + 10, frame.end() - 2);
    for (; payload.size() <= 53; payload.push_back(0)) {
      const Contents read = contents(test::hand_made_frame(84, payload, 143));
      ASSERT_EQ(read.packets.size(), 1u);
      EXPECT_EQ(fields(read.packets[0].message), fields(setpoint));
    }
  }
}

TEST(Frame, IsReadFromNoPayloadAtAll) {
  const Contents read = contents(test::hand_made_frame(84, {}, 143));
  ASSERT_EQ(read.packets.size(), 1u);
  EXPECT_EQ(fields(read.packets[0].message), fields(SetPositionTarget{}));
}

TEST(Frame, IsReadWhenANewerDefinitionAppendsFields) {
  Buffer payload(60, 0);
  payload[52] = 8;
  for (std::size_t i = 53; i < payload.size(); ++i) payload[i] = 0xFD;
  const Contents read = contents(test::hand_made_frame(84, payload, 143));
  ASSERT_EQ(read.packets.size(), 1u);
  EXPECT_EQ(std::get<SetPositionTarget>(read.packets[0].message).coordinate_frame, 8);
  EXPECT_TRUE(read.refusals.empty());
}

TEST(Frame, IsRefusedWithAnySingleBitFlipped) {
  test::Random random("bit flips");
  for (int i = 0; i < 60; ++i) {
    Buffer frame = test::random_frame(random);
    for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
      frame[bit / 8] = std::uint8_t(frame[bit / 8] ^ 1 << bit % 8);
      const Contents read = contents(frame);
      EXPECT_TRUE(read.packets.empty()) << "bit " << bit;
      EXPECT_EQ(read.size, frame.size());
      frame[bit / 8] = std::uint8_t(frame[bit / 8] ^ 1 << bit % 8);
    }
  }
}

TEST(Frame, IsRefusedWhenTruncatedAnywhere) {
  test::Random random("truncation");
  for (int i = 0; i < 60; ++i) {
    const Buffer frame = test::random_frame(random);
    for (std::size_t size = 1; size < frame.size(); ++size) {
      // A buffer of exactly that size, for the address sanitizer to watch.
      const Buffer part(frame.begin(), frame.begin() + std::ptrdiff_t(size));
      const Contents read = contents(part);
      EXPECT_TRUE(read.packets.empty());
      EXPECT_EQ(read.refusals.front(), Refusal::Truncated);
    }
  }
  const Decoded nothing = decode({});
  EXPECT_EQ(std::get<Refusal>(nothing.content), Refusal::Truncated);
  EXPECT_EQ(nothing.size, 0u);
}

TEST(Frame, IsRefusedForANamedReason) {
  const Buffer payload = {1, 2, 3};
  EXPECT_THAT(contents({1, 2, 3}).refusals, ElementsAre(Refusal::BadMagic));
  EXPECT_THAT(contents({0xFE, 0, 0, 1, 1, 0, 0, 0}).refusals, ElementsAre(Refusal::BadMagic));
  EXPECT_THAT(contents(test::hand_made_frame(84, payload, 142)).refusals,
              ElementsAre(Refusal::BadCrc));
  EXPECT_THAT(contents(test::hand_made_frame(86, payload, 140)).refusals,
              ElementsAre(Refusal::UnknownMessage));
  EXPECT_THAT(contents(test::hand_made_frame(84 + 0x10000, payload, 143)).refusals,
              ElementsAre(Refusal::UnknownMessage));
  EXPECT_THAT(contents(test::hand_made_frame(84, payload, 143, 0x02)).refusals,
              ElementsAre(Refusal::UnknownIncompatFlag));
  for (std::size_t i = 0; i < kRefusals; ++i) EXPECT_STRNE(name(Refusal(i)), "");
}

TEST(Frame, CarriesItsSignature) {
  Buffer frame = test::hand_made_frame(84, {1, 2, 3}, 143, kSigned);
  frame.insert(frame.end(), kSignatureSize, 0xFD);
  const Parsed parsed = parse(test::view(frame));
  const auto& view = std::get<FrameView>(parsed.content);
  EXPECT_TRUE(view.is_signed());
  EXPECT_EQ(view.message_id(), 84u);
  EXPECT_EQ(test::copy(view.payload()), (Buffer{1, 2, 3}));
  EXPECT_EQ(test::copy(view.signature()), Buffer(kSignatureSize, 0xFD));
  EXPECT_EQ(parsed.size, frame.size());
  const Buffer next = test::copy(encode(Heartbeat{}, {}).bytes());
  EXPECT_EQ(contents(test::joined({frame, next})).packets.size(), 2u);
  frame.pop_back();
  EXPECT_THAT(contents(frame).refusals, ElementsAre(Refusal::Truncated));
}

TEST(Frame, OfAnUnknownMessageIsSeenButNotRead) {
  const Buffer frame = test::hand_made_frame(86, {1, 2, 3}, 5);
  const Parsed parsed = parse(test::view(frame));
  const auto& view = std::get<FrameView>(parsed.content);
  EXPECT_EQ(view.info, nullptr);
  EXPECT_EQ(view.message_id(), 86u);
  EXPECT_EQ(test::copy(view.bytes), frame);
}

TEST(Frame, OfAnUnknownMessageWithUnknownFlagsIsRefused) {
  const Buffer frame = test::hand_made_frame(86, {1, 2, 3}, 5, 0x02);
  const Parsed parsed = parse(test::view(frame));
  EXPECT_EQ(std::get<Refusal>(parsed.content), Refusal::UnknownMessage);
  EXPECT_EQ(parsed.size, frame.size());
}

}  // namespace
}  // namespace kestrel::mavlink
