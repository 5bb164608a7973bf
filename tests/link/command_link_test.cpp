#include "kestrel/link/command_link.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "loopback.hpp"
#include "samples.hpp"

namespace kestrel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What one call of send puts on the wire.
struct Wire {
  std::vector<mavlink::Packet> packets;
  int datagrams = 0;

  const mavlink::SetPositionTarget& setpoint() const {
    return std::get<mavlink::SetPositionTarget>(packets.at(0).message);
  }
  bool has_heartbeat() const { return packets.size() == 2; }
};

class CommandLinkTest : public testing::Test {
 protected:
  Wire send(const VelocityCommand& command, double stamp_s) {
    link_.send(command, stamp_s);
    return arrived();
  }

  Wire arrived() {
    Wire wire;
    for (auto next = peer_.receive(test::kPatience_s); next; next = peer_.receive(0)) {
      const test::Contents read = test::contents(test::copy(next->bytes));
      EXPECT_TRUE(read.refusals.empty());
      EXPECT_EQ(read.packets.size(), 1u);  // one frame a datagram
      wire.packets.insert(wire.packets.end(), read.packets.begin(), read.packets.end());
      ++wire.datagrams;
    }
    return wire;
  }

  UdpSocket peer_ = UdpSocket::bound_to({"127.0.0.1", 0});
  CommandLink link_{peer_.local()};
};

TEST_F(CommandLinkTest, SendsTheVelocitiesAndTheTimeOfTheFrame) {
  const Wire wire = send({1.5, -2, 0.25, -0.5}, 12.345);
  const auto& s = wire.setpoint();
  EXPECT_EQ(s.vx_m_s, 1.5F);
  EXPECT_EQ(s.vy_m_s, -2);
  EXPECT_EQ(s.vz_m_s, 0.25F);
  EXPECT_EQ(s.yaw_rate_rad_s, -0.5F);
  EXPECT_EQ(s.time_boot_ms, 12345u);
  EXPECT_EQ(s.type_mask, 0x5C7);
  EXPECT_EQ(s.coordinate_frame, 8);
  EXPECT_EQ(s.target_system, 1);
  EXPECT_EQ(s.target_component, 1);
}

TEST_F(CommandLinkTest, SaysThatItIsTheCompanionOfTheVehicle) {
  const Wire wire = send({}, 0);
  ASSERT_TRUE(wire.has_heartbeat());
  const auto& heartbeat = std::get<mavlink::Heartbeat>(wire.packets[1].message);
  EXPECT_EQ(heartbeat.type, 18);
  EXPECT_EQ(heartbeat.autopilot, 8);
  EXPECT_EQ(heartbeat.system_status, 4);
  EXPECT_EQ(heartbeat.mavlink_version, 3);
  for (const auto& packet : wire.packets) {
    EXPECT_EQ(packet.envelope.system_id, 1);
    EXPECT_EQ(packet.envelope.component_id, 191);
  }
}

TEST_F(CommandLinkTest, NumbersItsFramesWithoutAGap) {
  std::uint8_t expected = 0;
  for (int i = 0; i < 600; ++i) {
    for (const auto& packet : send({}, i * 0.5).packets) {
      EXPECT_EQ(packet.envelope.sequence, expected++);
    }
  }
}

TEST_F(CommandLinkTest, BeatsOnceASecondByTheStampsAtAnyFrameRate) {
  for (const double rate : {3.3, 7.0, 29.97, 30.0}) {
    CommandLink link(peer_.local());
    const int frames = int(30 * rate);
    int beats = 0;
    for (int i = 0; i < frames; ++i) {
      link.send({}, 1000 + i / rate);
      const bool beat = arrived().has_heartbeat();
      if (beat) ++beats;
      // Beat k is due k seconds after the first and comes with the first frame after that.
      EXPECT_EQ(beats, 1 + int(i / rate + 1e-9)) << i;
    }
    EXPECT_EQ(link.counts().heartbeats, beats);
  }
}

TEST_F(CommandLinkTest, BeatsAtOnceAfterTheStampsJump) {
  EXPECT_TRUE(send({}, 100).has_heartbeat());
  EXPECT_FALSE(send({}, 100.5).has_heartbeat());
  EXPECT_TRUE(send({}, 500.2).has_heartbeat());
  EXPECT_FALSE(send({}, 500.3).has_heartbeat());
  EXPECT_FALSE(send({}, 501.1).has_heartbeat());
  EXPECT_TRUE(send({}, 501.2).has_heartbeat());
  EXPECT_TRUE(send({}, 3).has_heartbeat());
  EXPECT_FALSE(send({}, 3.9).has_heartbeat());
  EXPECT_TRUE(send({}, 4).has_heartbeat());
  EXPECT_TRUE(send({}, -1e300).has_heartbeat());
  EXPECT_TRUE(send({}, 1e300).has_heartbeat());
}

TEST_F(CommandLinkTest, AFrameWithoutATimeNeitherBeatsNorDisturbsTheBeat) {
  EXPECT_FALSE(send({}, kNan).has_heartbeat());
  EXPECT_TRUE(send({}, 1).has_heartbeat());
  EXPECT_FALSE(send({}, kInfinity).has_heartbeat());
  EXPECT_FALSE(send({}, kNan).has_heartbeat());
  EXPECT_FALSE(send({}, 1.5).has_heartbeat());
  EXPECT_TRUE(send({}, 2).has_heartbeat());
}

TEST_F(CommandLinkTest, SendsHoverForWhatIsNotFinite) {
  long replaced = 0;
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e200}) {
    for (int k = 0; k < 5; ++k) {
      Eigen::Vector4d v(1, 2, 3, 0.5);
      if (k < 4) v[k] = bad;
      // A stamp of 1e200 s is finite, if of no use.
      const double stamp_s = k < 4 ? 1.0 : std::isfinite(bad) ? kNan : bad;
      const Wire wire = send(VelocityCommand::from_vector(v), stamp_s);
      const auto velocity = velocity_of(wire.setpoint());
      ASSERT_TRUE(velocity);
      EXPECT_EQ(velocity->vector(), Eigen::Vector4d::Zero());
      EXPECT_EQ(link_.counts().replaced, ++replaced);
    }
  }
  EXPECT_EQ(link_.counts().commands, replaced);
  EXPECT_EQ(link_.failures(), 0);
  send({1, 0, 0, 0}, 2);
  EXPECT_EQ(link_.counts().replaced, replaced);
}

TEST_F(CommandLinkTest, SpeaksWithTheIdsItWasGiven) {
  LinkOptions options;
  options.to = {7, 2};
  options.system_id = 7;
  options.component_id = 195;
  CommandLink link(peer_.local(), options);
  link.send({}, 0);
  const Wire wire = arrived();
  EXPECT_EQ(wire.setpoint().target_system, 7);
  EXPECT_EQ(wire.setpoint().target_component, 2);
  EXPECT_EQ(wire.packets[0].envelope.system_id, 7);
  EXPECT_EQ(wire.packets[0].envelope.component_id, 195);
}

TEST(CommandLink, CountsEachCommandThatNobodyHeardAndNeverThrows) {
  CommandLink link(test::deaf_port());
  for (int i = 0; i < 100; ++i) link.send({1, 0, 0, 0}, i / 30.0);
  EXPECT_EQ(link.counts().commands, 100);
  // The refusal of the last is still to come.
  EXPECT_GE(link.failures(), 99);
  EXPECT_LE(link.failures(), 100);
}

TEST(CommandLink, RefusesOptionsAndPlacesThatMakeNoSense) {
  const Address somewhere{"127.0.0.1", 5005};
  LinkOptions nobody;
  nobody.system_id = 0;
  EXPECT_THROW(CommandLink(somewhere, nobody), std::invalid_argument);
  nobody = {};
  nobody.component_id = 0;
  EXPECT_THROW(CommandLink(somewhere, nobody), std::invalid_argument);
  EXPECT_THROW(CommandLink({"127.0.0.1", 0}), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
