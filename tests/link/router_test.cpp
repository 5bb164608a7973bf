#include "kestrel/link/router.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using Peers = std::vector<PeerId>;
using mavlink::Message;
using test::Buffer;

constexpr PeerId kFlight = 1, kEye = 2, kGround = 3, kOtherGround = 4, kScript = 5, kLogger = 6;
const mavlink::Envelope kVehicleIds{1, 1, 0}, kEyeIds{1, 191, 0}, kGroundIds{255, 190, 0},
    kOtherGroundIds{254, 190, 0}, kScriptIds{1, 193, 0};

/// All the roles, each with its ids heard at 0 s.
Router full() {
  Router router(RouterOptions{{1, 1}, {1, 192}, 5, 30});
  router.connect(kFlight, LinkRole::Flight);
  router.connect(kEye, LinkRole::Vision);
  router.connect(kGround, LinkRole::Ground);
  router.connect(kOtherGround, LinkRole::Ground);
  router.connect(kScript, LinkRole::Script);
  router.connect(kLogger, LinkRole::Telemetry);
  EXPECT_EQ(std::get<Arrival>(router.learn(kFlight, kVehicleIds, 0)), Arrival::New);
  EXPECT_EQ(std::get<Arrival>(router.learn(kEye, kEyeIds, 0)), Arrival::New);
  EXPECT_EQ(std::get<Arrival>(router.learn(kGround, kGroundIds, 0)), Arrival::New);
  EXPECT_EQ(std::get<Arrival>(router.learn(kOtherGround, kOtherGroundIds, 0)), Arrival::New);
  EXPECT_EQ(std::get<Arrival>(router.learn(kScript, kScriptIds, 0)), Arrival::New);
  return router;
}

Peers reached(Router& router, PeerId from, const Buffer& frame, double now_s = 1) {
  return router.destinations(
      from, std::get<mavlink::FrameView>(mavlink::parse(test::view(frame)).content), now_s);
}
Buffer framed(const Message& message) {
  return test::copy(mavlink::encode(message, {9, 9, 0}).bytes());
}
Peers reached(Router& router, PeerId from, const Message& message, double now_s = 1) {
  return reached(router, from, framed(message), now_s);
}

Message command_to(int system, int component) {
  mavlink::CommandLong message;
  message.target_system = std::uint8_t(system);
  message.target_component = std::uint8_t(component);
  return message;
}

std::optional<Refused> refusal(Router& router, PeerId from, const mavlink::Envelope& envelope,
                               double now_s = 1) {
  const auto learned = router.learn(from, envelope, now_s);
  const auto* reason = std::get_if<Refused>(&learned);
  return reason != nullptr ? std::optional(*reason) : std::nullopt;
}

TEST(Router, SendsWhatIsForEverybodyToAllButTheSender) {
  Router router = full();
  EXPECT_EQ(reached(router, kFlight, mavlink::Heartbeat{}),
            (Peers{kEye, kGround, kOtherGround, kScript, kLogger}));
  EXPECT_EQ(reached(router, kGround, mavlink::Heartbeat{}),
            (Peers{kFlight, kEye, kOtherGround, kScript, kLogger}));
}

TEST(Router, TellsEachRoleWhatItNeeds) {
  Router router = full();
  const Peers listeners = {kGround, kOtherGround, kLogger};
  EXPECT_EQ(reached(router, kFlight, mavlink::StatusText{}), listeners);
  EXPECT_EQ(reached(router, kFlight, mavlink::ParamValue{}), listeners);
  EXPECT_EQ(reached(router, kFlight, mavlink::ServoOutputRaw{}), listeners);
  const Peers all = {kEye, kGround, kOtherGround, kScript, kLogger};
  for (const Message& each : {Message(mavlink::AttitudeReport{}), Message(mavlink::LocalPosition{}),
                              Message(mavlink::TimeSync{}), Message(mavlink::ExtendedSysState{})}) {
    EXPECT_EQ(reached(router, kFlight, each), all);
  }
}

TEST(Router, SendsWhatHasATargetToItsPlaceOnly) {
  Router router = full();
  EXPECT_EQ(reached(router, kGround, command_to(1, 1)), (Peers{kFlight}));
  EXPECT_EQ(reached(router, kOtherGround, command_to(255, 190)), (Peers{kGround}));
  EXPECT_EQ(reached(router, kGround, command_to(1, 0)), (Peers{kFlight}));  // of those told
  EXPECT_EQ(reached(router, kGround, command_to(77, 1)), Peers{});
  EXPECT_EQ(reached(router, kGround, command_to(1, 55)), Peers{});
  mavlink::CommandAck ack;
  ack.target_system = 1;
  ack.target_component = 191;
  EXPECT_EQ(reached(router, kFlight, ack), (Peers{kEye}));
  ack.target_component = 0;
  EXPECT_EQ(reached(router, kFlight, ack), (Peers{kEye, kScript}));
  EXPECT_EQ(reached(router, kGround, command_to(1, 192)), Peers{});  // for the switch itself
}

TEST(Router, NeverSendsBackNorWhatNobodyMayHave) {
  Router router = full();
  test::Random random("router");
  const Peers peers = {kFlight, kEye, kGround, kOtherGround, kScript, kLogger};
  for (int i = 0; i < 3000; ++i) {
    const PeerId from = peers[std::size_t(random.integer(0, 5))];
    const Message message = test::random_message(random);
    const Peers to = reached(router, from, message);
    EXPECT_EQ(std::count(to.begin(), to.end(), from), 0);
    if (std::holds_alternative<mavlink::SetupSigning>(message)) {
      EXPECT_TRUE(to.empty());
    }
  }
}

TEST(Router, SendsUnknownMessagesToTheGroundAlone) {
  Router router = full();
  const Buffer unknown = test::hand_made_frame(12345, {1, 2, 3}, 7);
  EXPECT_EQ(reached(router, kFlight, unknown), (Peers{kGround, kOtherGround}));
  EXPECT_EQ(reached(router, kGround, unknown), (Peers{kOtherGround}));
  EXPECT_EQ(reached(router, kEye, unknown), (Peers{kGround, kOtherGround}));
}

TEST(Router, NeverSendsFromFlightControlToFlightControl) {
  Router router = full();
  router.connect(9, LinkRole::Flight);
  const Peers to = reached(router, kFlight, mavlink::Heartbeat{});
  EXPECT_EQ(std::count(to.begin(), to.end(), 9u), 0);
}

TEST(Router, RefusesSourcesThatCannotBe) {
  Router router = full();
  for (const PeerId peer : {kFlight, kEye, kGround, kScript, kLogger}) {
    EXPECT_EQ(refusal(router, peer, {0, 1, 0}), Refused::NoSource);
    EXPECT_EQ(refusal(router, peer, {1, 192, 0}), Refused::OwnIds);
    if (peer != kFlight) {
      EXPECT_EQ(refusal(router, peer, {1, 1, 0}), Refused::VehicleIds);
    }
  }
  EXPECT_FALSE(refusal(router, kFlight, {1, 1, 0}));
}

TEST(Router, RefusesIdsThatAreLiveBehindAnotherRole) {
  Router router = full();
  EXPECT_EQ(refusal(router, kScript, kEyeIds, 4), Refused::IdsTaken);
  EXPECT_EQ(refusal(router, kFlight, kGroundIds, 4), Refused::IdsTaken);
  EXPECT_FALSE(refusal(router, kOtherGround, kGroundIds, 4));  // two stations of the same ids
  EXPECT_EQ(reached(router, kFlight, command_to(255, 190)), (Peers{kGround, kOtherGround}));
  EXPECT_FALSE(refusal(router, kScript, kEyeIds, 5.1));  // silent for longer than live_s
}

TEST(Router, ForgetsTheSilentAndTheGone) {
  Router router = full();
  EXPECT_EQ(reached(router, kGround, command_to(254, 190), 30), (Peers{kOtherGround}));
  EXPECT_EQ(reached(router, kGround, command_to(254, 190), 30.1), Peers{});
  EXPECT_EQ(reached(router, kGround, command_to(1, 1), 1000), (Peers{kFlight}));  // by the options
  router.disconnect(kFlight);
  EXPECT_EQ(reached(router, kGround, command_to(1, 1)), Peers{});
  EXPECT_EQ(refusal(router, kFlight, kVehicleIds), Refused::NoSource);
}

TEST(Router, IsBoundedAndFloodsOfIdsHurtTheirPeerOnly) {
  Router router = full();
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(refusal(router, kScript, {std::uint8_t(2 + i), 7, 0}, 1 + 0.001 * i));
  }
  EXPECT_EQ(reached(router, kScript, command_to(255, 190)), (Peers{kGround}));
  int known = 0;
  for (int i = 0; i < 200; ++i) {
    known += int(!reached(router, kEye,
                          [&] {
                            mavlink::CommandAck ack;
                            ack.target_system = std::uint8_t(2 + i);
                            ack.target_component = 7;
                            return Message(ack);
                          }())
                      .empty());
  }
  EXPECT_EQ(known, int(Router::kIdsPerPeer));
}

TEST(Router, TellsRepeatedFrames) {
  Router router = full();
  EXPECT_EQ(std::get<Arrival>(router.learn(kEye, {1, 191, 1}, 1)), Arrival::New);
  EXPECT_EQ(std::get<Arrival>(router.learn(kEye, {1, 191, 1}, 1)), Arrival::Duplicate);
  EXPECT_EQ(std::get<Arrival>(router.learn(kEye, {1, 191, 3}, 1)), Arrival::New);
  EXPECT_EQ(std::get<Arrival>(router.learn(kEye, {1, 191, 2}, 1)), Arrival::Late);
  EXPECT_EQ(std::get<Arrival>(router.learn(kEye, {1, 195, 1}, 1)), Arrival::New);
}

TEST(FrameTarget, IsReadAlsoWhenTrimmed) {
  const auto of = [](const Message& message) {
    const Buffer frame = framed(message);
    return target_of(std::get<mavlink::FrameView>(mavlink::parse(test::view(frame)).content));
  };
  EXPECT_EQ(of(command_to(3, 4)).system_id, 3);
  EXPECT_EQ(of(command_to(3, 4)).component_id, 4);
  EXPECT_EQ(of(mavlink::CommandLong{}).system_id, 0);
  EXPECT_TRUE(of(mavlink::CommandLong{}).named);
  EXPECT_FALSE(of(mavlink::Heartbeat{}).named);
  mavlink::ManualControl sticks;
  sticks.target = 8;
  EXPECT_EQ(of(sticks).system_id, 8);
  EXPECT_EQ(of(sticks).component_id, 0);
}

}  // namespace
}  // namespace kestrel
