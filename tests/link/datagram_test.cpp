// How whole datagrams are read: several frames, garbage, lies about the length.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/link/frame.hpp"

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;
using test::contents;
using test::Contents;
using test::joined;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<int> sequences(const Contents& read) {
  std::vector<int> all;
  for (const Packet& packet : read.packets) all.push_back(packet.envelope.sequence);
  return all;
}

Buffer numbered(test::Random& random, int sequence) {
  return test::copy(encode(test::random_message(random), {1, 191, std::uint8_t(sequence)}).bytes());
}

TEST(Datagram, HoldsSeveralFrames) {
  test::Random random("several");
  Buffer datagram;
  std::vector<int> sent;
  for (int i = 0; i < 20; ++i) {
    datagram = joined({datagram, numbered(random, i)});
    sent.push_back(i);
    const Contents read = contents(datagram);
    EXPECT_EQ(sequences(read), sent);
    EXPECT_THAT(read.refusals, IsEmpty());
    EXPECT_EQ(read.size, datagram.size());
  }
}

TEST(Datagram, GarbageBetweenFramesCostsNoFrame) {
  test::Random random("garbage");
  for (int i = 0; i < 500; ++i) {
    const auto garbage = [&] {
      Buffer bytes(std::size_t(random.integer(1, 40)));
      for (auto& byte : bytes) byte = std::uint8_t(random.integer(0, 0xFC));
      return bytes;
    };
    const Contents read = contents(joined({garbage(), numbered(random, 1), garbage(),
                                           numbered(random, 2), numbered(random, 3), garbage()}));
    EXPECT_THAT(sequences(read), ElementsAre(1, 2, 3));
    EXPECT_THAT(read.refusals,
                ElementsAre(Refusal::BadMagic, Refusal::BadMagic, Refusal::BadMagic));
  }
}

TEST(Datagram, ALieAboutTheLengthCostsNoOtherFrame) {
  test::Random random("length lies");
  for (int length = 0; length < 256; ++length) {
    Buffer liar = numbered(random, 1);
    if (liar[1] == length) continue;
    liar[1] = std::uint8_t(length);
    const Contents read = contents(joined({numbered(random, 0), liar, numbered(random, 2),
                                           numbered(random, 3), numbered(random, 4)}));
    EXPECT_THAT(sequences(read), ElementsAre(0, 2, 3, 4)) << length;
  }
}

TEST(Datagram, ADamagedFrameCostsNoOtherFrame) {
  test::Random random("damage");
  for (int i = 0; i < 30; ++i) {
    Buffer frame = numbered(random, 1);
    for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
      Buffer damaged = frame;
      damaged[bit / 8] = std::uint8_t(damaged[bit / 8] ^ 1 << bit % 8);
      const Contents read = contents(joined({numbered(random, 0), damaged, numbered(random, 2)}));
      EXPECT_THAT(sequences(read), ElementsAre(0, 2)) << "bit " << bit;
    }
  }
}

TEST(Datagram, AFalseStartOfAnUnknownMessageCostsNoFrame) {
  test::Random random("false start");
  const Buffer frame = numbered(random, 1);
  for (std::size_t length = 0; length < 256; ++length) {
    Buffer start = {0xFD, std::uint8_t(length), 0, 0, 0, 1, 1, 0xAA, 0xBB, 0, 0x11, 0x22, 0x33};
    const Buffer datagram = joined({start, frame});
    const std::size_t end = 12 + length;
    // What ends with the datagram, or before a mark, looks like a whole frame: the next test.
    if (end == datagram.size() || (end < datagram.size() && datagram[end] == 0xFD)) continue;
    EXPECT_THAT(sequences(contents(datagram)), ElementsAre(1)) << length;
  }
}

TEST(Datagram, WhatAnUnknownMessageCarriesIsNotObeyed) {
  test::Random random("tunnel");
  const Buffer carried = numbered(random, 66);
  const Buffer tunnel = test::hand_made_frame(385, joined({{5, 6}, carried, {7}}), 147);
  const Contents alone = contents(tunnel);
  EXPECT_THAT(sequences(alone), IsEmpty());
  EXPECT_THAT(alone.refusals, ElementsAre(Refusal::UnknownMessage));
  const Contents among = contents(joined({numbered(random, 1), tunnel, numbered(random, 2)}));
  EXPECT_THAT(sequences(among), ElementsAre(1, 2));
}

TEST(Datagram, HalvesAreNotPutTogether) {
  test::Random random("halves");
  for (int i = 0; i < 200; ++i) {
    const Buffer frame = test::random_frame(random);
    const auto cut = frame.begin() + random.integer(1, int(frame.size()) - 1);
    EXPECT_THAT(contents(Buffer(frame.begin(), cut)).packets, IsEmpty());
    EXPECT_THAT(contents(Buffer(cut, frame.end())).packets, IsEmpty());
  }
}

TEST(Datagram, AnyBytesAreReadToTheirEndAndNoFrameIsInvented) {
  test::Random random("noise");
  for (int i = 0; i < 2000; ++i) {
    Buffer noise(std::size_t(random.integer(1, 400)));
    // Marks, known ids and zeros are frequent, so that all of the decoder is reached.
    static const std::uint8_t kFrequent[] = {0xFD, 0xFD, 0, 0, 84, 9, 53, 1};
    for (auto& byte : noise) {
      byte =
          random.integer(0, 1) == 0 ? kFrequent[random.integer(0, 7)] : test::random_byte(random);
    }
    const Contents read = contents(noise);
    EXPECT_EQ(read.size, noise.size());
    EXPECT_THAT(read.packets, IsEmpty());  // one in 65536 would be chance: none with this seed
  }
}

}  // namespace
}  // namespace kestrel::mavlink
