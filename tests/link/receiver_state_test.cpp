#include "kestrel/link/receiver_state.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using mavlink::Refusal;
using test::Buffer;

const Address kPeer{"127.0.0.1", 4000};

mavlink::SetPositionTarget setpoint(double forward_m_s) {
  return velocity_setpoint({forward_m_s, 0, 0, 0}, 1000, {});
}

Buffer framed(const mavlink::Message& message, int sequence, std::uint8_t component = 191) {
  return test::copy(mavlink::encode(message, {1, component, std::uint8_t(sequence)}).bytes());
}

TEST(ReceiverState, HandsOnWhatWasSent) {
  ReceiverState state;
  const auto commands = state.take(
      test::view(test::joined({framed(velocity_setpoint({1, 2, 3, 0.5}, 1234, {}), 7),
                               framed(mavlink::Heartbeat{}, 8), framed(setpoint(-1), 9)})),
      kPeer);
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commands[0].command.vector(), Eigen::Vector4d(1, 2, 3, 0.5));
  EXPECT_EQ(commands[0].time_boot_ms, 1234u);
  EXPECT_EQ(commands[0].envelope.sequence, 7);
  EXPECT_EQ(commands[0].envelope.system_id, 1);
  EXPECT_EQ(commands[0].envelope.component_id, 191);
  EXPECT_EQ(commands[1].command.forward_m_s, -1);
  EXPECT_EQ(state.counts().datagrams, 1);
  EXPECT_EQ(state.counts().commands, 2);
  EXPECT_EQ(state.counts().heartbeats, 1);
  EXPECT_EQ(state.counts().lost, 0);
  EXPECT_EQ(state.counts().malformed(), 0);
}

TEST(ReceiverState, CountsAddUpUnderLossReorderAndDuplication) {
  test::Random random("receiver");
  std::vector<std::pair<double, int>> arrivals;
  long sent = 0;
  long delivered = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool edge = i == 0 || i == 2999;  // the ends arrive, so that every loss is a gap
    ++sent;
    if (!edge && random.integer(0, 3) == 0) continue;
    ++delivered;
    arrivals.emplace_back(i + (edge ? 0 : random.uniform(0, 8)), i);
    if (!edge && random.integer(0, 5) == 0) arrivals.emplace_back(i + random.uniform(0, 8), i);
  }
  std::sort(arrivals.begin() + 1, arrivals.end());
  ReceiverState state;
  double last_m_s = -1;
  for (const auto& [time, number] : arrivals) {
    for (const auto& received : state.take(test::view(framed(setpoint(number), number)), kPeer)) {
      EXPECT_GT(received.command.forward_m_s, last_m_s);  // never an older one
      last_m_s = received.command.forward_m_s;
    }
  }
  const ReceiverCounts& counts = state.counts();
  EXPECT_EQ(counts.datagrams, long(arrivals.size()));
  EXPECT_EQ(counts.commands + counts.late, delivered);
  EXPECT_EQ(counts.commands + counts.late + counts.duplicates, counts.datagrams);
  EXPECT_EQ(counts.lost, sent - delivered);
  EXPECT_GT(counts.late, 0);
  EXPECT_GT(counts.duplicates, 0);
}

TEST(ReceiverState, RefusesWhatIsNotFinite) {
  ReceiverState state;
  auto bad = setpoint(1);
  bad.yaw_rad = std::numeric_limits<float>::quiet_NaN();  // although the mask says to ignore it
  EXPECT_TRUE(state.take(test::view(framed(bad, 0)), kPeer).empty());
  bad = setpoint(1);
  bad.vz_m_s = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(state.take(test::view(framed(bad, 1)), kPeer).empty());
  EXPECT_EQ(state.counts().not_finite, 2);
  EXPECT_EQ(state.counts().commands, 0);
}

TEST(ReceiverState, RefusesOtherFramesMasksAndVehicles) {
  ReceiverState state({3, 1});
  auto send = [&, sequence = 0](int system, int component, int frame, int mask) mutable {
    auto s = velocity_setpoint({1, 0, 0, 0}, 0, {std::uint8_t(system), std::uint8_t(component)});
    s.coordinate_frame = std::uint8_t(frame);
    s.type_mask = std::uint16_t(mask);
    return state.take(test::view(framed(s, sequence++)), kPeer).size();
  };
  EXPECT_EQ(send(3, 1, 8, 0x5C7), 1u);
  EXPECT_EQ(send(0, 0, 8, 0x5C7), 1u);
  EXPECT_EQ(send(3, 1, 1, 0x5C7), 0u);
  EXPECT_EQ(send(3, 1, 8, 0xDC7), 0u);
  EXPECT_EQ(state.counts().unsupported, 2);
  EXPECT_EQ(send(1, 1, 8, 0x5C7), 0u);
  EXPECT_EQ(send(3, 2, 8, 0x5C7), 0u);
  EXPECT_EQ(state.counts().misaddressed, 2);
}

TEST(ReceiverState, CountsWhatItCannotReadByReason) {
  ReceiverState state;
  Buffer damaged = framed(setpoint(1), 0);
  damaged[15] ^= 1;
  const Buffer whole = framed(setpoint(1), 0);
  const Buffer half(whole.begin(), whole.begin() + 30);
  for (const Buffer& datagram :
       {Buffer{}, Buffer{1, 2, 3}, damaged, half, test::hand_made_frame(86, {1}, 39),
        test::hand_made_frame(84, {1}, 143, 2)}) {
    EXPECT_TRUE(state.take(test::view(datagram), kPeer).empty());
  }
  const ReceiverCounts& counts = state.counts();
  EXPECT_EQ(counts.datagrams, 6);
  EXPECT_EQ(counts.refused_as(Refusal::Truncated), 2);  // the empty one too
  EXPECT_EQ(counts.refused_as(Refusal::BadMagic), 1);
  EXPECT_EQ(counts.refused_as(Refusal::BadCrc), 1);
  EXPECT_EQ(counts.refused_as(Refusal::UnknownMessage), 1);
  EXPECT_EQ(counts.refused_as(Refusal::UnknownIncompatFlag), 1);
  EXPECT_EQ(counts.malformed(), 5);
}

TEST(ReceiverState, KeepsNothingForTheNextDatagram) {
  ReceiverState state;
  const Buffer frame = framed(setpoint(1), 0);
  for (std::ptrdiff_t cut = 1; cut < std::ptrdiff_t(frame.size()); ++cut) {
    EXPECT_TRUE(state.take(test::view(Buffer(frame.begin(), frame.begin() + cut)), kPeer).empty());
    EXPECT_TRUE(state.take(test::view(Buffer(frame.begin() + cut, frame.end())), kPeer).empty());
  }
  EXPECT_EQ(state.counts().commands, 0);
}

TEST(ReceiverState, CountsTheSequenceOfEachSenderApart) {
  ReceiverState state;
  const Address restarted{"127.0.0.1", 4001};
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(state.take(test::view(framed(setpoint(1), i)), kPeer).size(), 1u);
    EXPECT_EQ(state.take(test::view(framed(setpoint(1), 200 + i, 190)), kPeer).size(), 1u);
  }
  EXPECT_EQ(state.take(test::view(framed(setpoint(1), 0)), restarted).size(), 1u);
  EXPECT_EQ(state.counts().lost, 0);
  EXPECT_EQ(state.counts().duplicates, 0);
}

TEST(ReceiverState, ForgetsTheSenderSilentForLongest) {
  ReceiverState state;
  const auto send = [&](int port, int sequence) {
    return state.take(test::view(framed(setpoint(1), sequence)), {"::1", std::uint16_t(port)})
        .size();
  };
  const int senders = int(ReceiverState::kMaxSenders);
  for (int port = 0; port < senders; ++port) EXPECT_EQ(send(port, 0), 1u);
  EXPECT_EQ(send(0, 1), 1u);        // speaks again: now sender 1 is the silent one
  EXPECT_EQ(send(senders, 0), 1u);  // one more: sender 1 goes
  EXPECT_EQ(send(0, 1), 0u);        // a duplicate: still known
  EXPECT_EQ(send(2, 0), 0u);        // the same
  EXPECT_EQ(send(1, 0), 1u);        // not known any more
}

}  // namespace
}  // namespace kestrel
