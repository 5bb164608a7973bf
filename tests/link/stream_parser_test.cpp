#include "kestrel/link/stream_parser.hpp"

#include <algorithm>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;
using testing::ElementsAre;
using testing::IsEmpty;

/// What a parser gives for a chunk; the sizes it tells add up in `passed`.
struct Seen {
  std::vector<Buffer> frames;
  std::vector<Refusal> refusals;
  std::size_t passed = 0;
};

void feed(StreamParser& parser, Bytes chunk, Seen& seen) {
  while (chunk.size > 0) {
    const Bytes rest = parser.push(chunk);
    ASSERT_LT(rest.size, chunk.size);  // else it never ends
    chunk = rest;
    while (const auto parsed = parser.next()) {
      if (const auto* frame = std::get_if<FrameView>(&parsed->content)) {
        seen.frames.push_back(test::copy(frame->bytes));
        EXPECT_EQ(frame->bytes.size, parsed->size);
      } else {
        seen.refusals.push_back(std::get<Refusal>(parsed->content));
      }
      ASSERT_GT(parsed->size, 0u);
      seen.passed += parsed->size;
    }
  }
}

Seen seen_in(const Buffer& stream, std::size_t chunk_size) {
  StreamParser parser;
  Seen seen;
  for (Bytes rest = test::view(stream); rest.size > 0; rest = rest.after(chunk_size)) {
    feed(parser, rest.first(chunk_size), seen);
  }
  return seen;
}

/// Any bytes, marks very often among them but not in front: there they could pose as a message that
/// is not known.
Buffer garbage(test::Random& random) {
  Buffer bytes(std::size_t(random.integer(0, 400)));
  for (std::uint8_t& byte : bytes) {
    byte = random.integer(0, 7) == 0 ? kMagic : test::random_byte(random);
  }
  if (!bytes.empty() && bytes[0] == kMagic) bytes[0] = 0xFE;
  return bytes;
}

/// A frame with a bit flipped behind its message id, or cut short: it may claim what follows it.
Buffer damaged(test::Random& random) {
  Buffer frame = test::random_frame(random);
  if (random.integer(0, 1) == 0) {
    frame.resize(std::size_t(random.integer(10, int(frame.size()) - 1)));
  } else {
    const int at = random.integer(10, int(frame.size()) - 1);
    frame[std::size_t(at)] ^= std::uint8_t(1 << random.integer(0, 7));
  }
  return frame;
}

/// Frames among garbage and damaged frames; behind them a frame's length of zeros, so that no false
/// claim is still open at the end.
struct Stream {
  Buffer bytes;
  std::vector<Buffer> frames;
};

Stream random_stream(test::Random& random) {
  std::vector<Buffer> parts;
  Stream stream;
  for (int i = 0; i < 30; ++i) {
    const int kind = random.integer(0, 3);
    if (kind == 0) parts.push_back(garbage(random));
    if (kind == 1) parts.push_back(damaged(random));
    if (kind >= 2) parts.push_back(test::random_frame(random));
    if (kind >= 2) stream.frames.push_back(parts.back());
  }
  parts.emplace_back(kMaxFrame, 0);
  stream.bytes = test::joined(parts);
  return stream;
}

TEST(StreamParser, FindsExactlyTheIntactFramesHoweverTheStreamIsCut) {
  test::Random random("streams");
  for (int i = 0; i < 60; ++i) {
    const Stream stream = random_stream(random);
    for (const std::size_t chunk : {std::size_t(1), std::size_t(random.integer(2, 50)),
                                    std::size_t(random.integer(51, 3000)), stream.bytes.size()}) {
      const Seen seen = seen_in(stream.bytes, chunk);
      ASSERT_EQ(seen.frames, stream.frames) << "chunks of " << chunk;
      EXPECT_EQ(seen.passed, stream.bytes.size());
    }
  }
}

TEST(StreamParser, TellsAFrameWithItsLastByte) {
  const Buffer frame = test::copy(encode(SetPositionTarget{}, {}).bytes());
  StreamParser parser;
  Seen seen;
  for (int i = 1; i <= 3; ++i) {
    feed(parser, test::view(frame).first(frame.size() - 1), seen);
    EXPECT_EQ(seen.frames.size(), std::size_t(i - 1));
    feed(parser, test::view(frame).after(frame.size() - 1), seen);
    EXPECT_EQ(seen.frames.size(), std::size_t(i));
  }
  EXPECT_THAT(seen.refusals, IsEmpty());
}

TEST(StreamParser, AFalseClaimHoldsUpNoMoreThanItClaims) {
  test::Random random("false claims");
  for (const std::uint8_t incompat : {std::uint8_t{0}, kSigned}) {
    StreamParser parser;
    Seen seen;
    const Buffer claim = {kMagic, 255, incompat, 0, 0, 1, 191, 84, 0, 0};
    feed(parser, test::view(claim), seen);
    std::size_t sent = claim.size(), frames = 0;
    for (; seen.frames.empty() && frames < 300; ++frames) {
      const Buffer frame = test::random_frame(random);
      feed(parser, test::view(frame), seen);
      sent += frame.size();
      EXPECT_TRUE(!seen.frames.empty() || sent < kMaxFrame);
    }
    EXPECT_EQ(seen.frames.size(), frames);  // all of them, the first one too
  }
}

TEST(StreamParser, BehindGarbageAnUnknownClaimHoldsUpNothing) {
  const Buffer claim = {0, kMagic, 255, 0, 0, 0, 1, 191, 7, 7, 7};
  const Buffer frame = test::copy(encode(Heartbeat{}, {}).bytes());
  EXPECT_EQ(seen_in(test::joined({claim, frame}), 1).frames, std::vector<Buffer>{frame});
}

TEST(StreamParser, PassesOnAnUnknownMessageButNothingInsideOfIt) {
  const Buffer heartbeat = test::copy(encode(Heartbeat{}, {}).bytes());
  const Buffer log = test::hand_made_frame(120, test::joined({heartbeat, heartbeat}), 0);
  const Buffer stream = test::joined({log, heartbeat, log, log, heartbeat});
  const std::vector<Buffer> all = {log, heartbeat, log, log, heartbeat};
  for (const std::size_t chunk : {1, 7, 1000}) {
    EXPECT_EQ(seen_in(stream, chunk).frames, all);
    EXPECT_THAT(seen_in(stream, chunk).refusals, IsEmpty());
  }
  // The last one waits for the mark of the next.
  EXPECT_EQ(seen_in(test::joined({heartbeat, log}), 1).frames.size(), 1u);
}

TEST(StreamParser, DoesNotBelieveAnUnknownMessageThatEndsNowhere) {
  const Buffer heartbeat = test::copy(encode(Heartbeat{}, {}).bytes());
  const Buffer log = test::hand_made_frame(120, {1, 2, 3}, 0);
  const Seen seen = seen_in(test::joined({log, {0}, log, heartbeat}), 5);
  EXPECT_EQ(seen.frames, std::vector<Buffer>{heartbeat});
  EXPECT_EQ(seen.refusals.front(), Refusal::BadCrc);
}

TEST(StreamParser, PassesOverAFrameWithUnknownFlagsAsAWhole) {
  const Buffer heartbeat = test::copy(encode(Heartbeat{}, {}).bytes());
  const Buffer flagged = test::hand_made_frame(84, heartbeat, 143, 0x02);
  const Seen seen = seen_in(test::joined({flagged, heartbeat}), 1);
  EXPECT_EQ(seen.frames.size(), 1u);
  EXPECT_THAT(seen.refusals, ElementsAre(Refusal::UnknownIncompatFlag));
  // Of a message that is not known, nothing vouches for its end.
  const Buffer unknown = test::hand_made_frame(120, {1, 2, 3}, 0, 0x02);
  EXPECT_EQ(seen_in(test::joined({unknown, heartbeat}), 1).frames, std::vector<Buffer>{heartbeat});
}

TEST(StreamParser, KeepsWhatItHasWhenNobodyAsks) {
  test::Random random("not asked");
  std::vector<Buffer> frames;
  for (int i = 0; i < 200; ++i) frames.push_back(test::random_frame(random));
  const Buffer stream = test::joined(frames);
  StreamParser parser;
  const Bytes rest = parser.push(test::view(stream));
  EXPECT_LT(rest.size, stream.size());
  EXPECT_EQ(parser.push(rest).size, rest.size);  // full
  Seen seen;
  while (const auto parsed = parser.next()) {
    seen.frames.push_back(test::copy(std::get<FrameView>(parsed->content).bytes));
  }
  feed(parser, rest, seen);
  EXPECT_EQ(seen.frames, frames);
}

}  // namespace
}  // namespace kestrel::mavlink
