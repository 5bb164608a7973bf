#include "kestrel/link/command_desk.hpp"

#include <gtest/gtest.h>

#include "kestrel/link/setpoint.hpp"

#include "support/random.hpp"

namespace kestrel {
namespace {

const Claimant kGround{{1, 255, 190}, LinkRole::Ground, 100};
const Claimant kEye{{2, 1, 191}, LinkRole::Vision, 50};
const Claimant kScript{{4, 1, 193}, LinkRole::Script, 10};
const CommandDeskOptions kOptions{{}, 0.05, 0.5, 0.5, 5};

std::optional<Refused> say(CommandDesk& desk, const Claimant& who, double now_s,
                           double forward_m_s = 0.1) {
  return desk.setpoint(who, velocity_setpoint({forward_m_s, 0, 0, 0}, time_boot_ms(now_s), {}),
                       Arrival::New, now_s);
}

TEST(CommandDesk, IsSilentUntilSomebodyHadControl) {
  CommandDesk desk(kOptions);
  for (double now_s = 0; now_s < 3; now_s += 0.05) EXPECT_FALSE(desk.due(now_s));
}

TEST(CommandDesk, BeginsWithAZeroAndThenPassesEachSetpointAtOnce) {
  CommandDesk desk(kOptions);
  EXPECT_FALSE(say(desk, kEye, 1));
  EXPECT_TRUE(is_hover(desk.due(1)->command));
  EXPECT_FALSE(desk.due(1));
  EXPECT_FALSE(say(desk, kEye, 1.03));
  EXPECT_NEAR(desk.due(1.03)->command.forward_m_s, 0.06, 1e-6);  // 2 m/s^2 for 0.03 s
  EXPECT_FALSE(say(desk, kEye, 1.06));
  const auto sent = desk.due(1.06);
  EXPECT_FLOAT_EQ(float(sent->command.forward_m_s), 0.1F);
  EXPECT_NEAR(sent->captured_s, 1.06, 0.001);
}

TEST(CommandDesk, FillsTheStreamWhileFreshAndZeroesItAtTheDeadman) {
  CommandDesk desk(kOptions);
  say(desk, kEye, 1);
  desk.due(1);
  say(desk, kEye, 1.1);
  desk.due(1.1);
  long filled = 0;
  for (int i = 1; i < 50; ++i) {
    const auto sent = desk.due(1.1 + 0.01 * i);
    filled += sent ? 1 : 0;
    if (sent) {
      EXPECT_GT(sent->command.forward_m_s, 0);
    }
  }
  EXPECT_GE(filled, 8);  // 0.49 s at 20 Hz
  EXPECT_EQ(desk.deadman_count(), 0u);
  EXPECT_TRUE(is_hover(desk.due(1.6001)->command));
  EXPECT_EQ(desk.deadman_count(), 1u);
  EXPECT_EQ(desk.arbiter().state(), ControlState::Hold);
  for (int i = 1; i < 200; ++i) {
    const auto sent = desk.due(1.6001 + 0.051 * i);  // zeros, never silence
    ASSERT_TRUE(sent);
    EXPECT_TRUE(is_hover(sent->command));
  }
}

// The sooner of the two ends counts.
TEST(CommandDesk, ZeroesAtADeadmanThatIsShorterThanTheTimeToLive) {
  CommandDeskOptions options = kOptions;
  options.deadman_s = 0.2;
  CommandDesk desk(options);
  say(desk, kEye, 1);
  desk.due(1);
  say(desk, kEye, 1.1);
  EXPECT_GT(desk.due(1.1)->command.forward_m_s, 0);
  desk.due(1.25);
  EXPECT_EQ(desk.deadman_count(), 0u);
  EXPECT_TRUE(is_hover(desk.due(1.301)->command));
  EXPECT_EQ(desk.deadman_count(), 1u);
}

// The capture counts, not the arrival: a setpoint that came 0.3 s late is followed for 0.2 s.
TEST(CommandDesk, CountsFromTheCapture) {
  CommandDesk desk(kOptions);
  const auto say_late = [&](double captured_s, double now_s) {
    return desk.setpoint(kEye, velocity_setpoint({0.1, 0, 0, 0}, time_boot_ms(captured_s), {}),
                         Arrival::New, now_s);
  };
  EXPECT_FALSE(say_late(1, 1));
  desk.due(1);
  EXPECT_FALSE(say_late(1.1, 1.4));
  EXPECT_FALSE(is_hover(desk.due(1.4)->command));
  desk.due(1.59);
  EXPECT_FALSE(is_hover(desk.stream().sent()));
  EXPECT_TRUE(is_hover(desk.due(1.601)->command));
}

TEST(CommandDesk, SendsAZeroAtEachHandOver) {
  CommandDesk desk(kOptions);
  for (int i = 0; i < 10; ++i) {
    say(desk, kScript, 1 + 0.05 * i);
    desk.due(1 + 0.05 * i);
  }
  EXPECT_FALSE(is_hover(desk.stream().sent()));
  EXPECT_FALSE(say(desk, kEye, 1.5, -0.1));
  EXPECT_TRUE(is_hover(desk.due(1.5)->command));
  EXPECT_EQ(say(desk, kScript, 1.51), Refused::NotOwner);
  EXPECT_FALSE(desk.due(1.51));
  EXPECT_FALSE(say(desk, kEye, 1.52, -0.1));
  EXPECT_LT(desk.due(1.52)->command.forward_m_s, 0);
  desk.forget(kEye.id.peer, 1.53);  // the script is live
  EXPECT_TRUE(is_hover(desk.due(1.53)->command));
  EXPECT_EQ(desk.arbiter().owner(), kScript.id);
}

TEST(CommandDesk, SendsAZeroAtEachControlMessageThatChangesAnything) {
  for (const auto what : {SwitchControl::TakeOver, SwitchControl::Release,
                          SwitchControl::EmergencyStop, SwitchControl::Reset}) {
    CommandDesk desk(kOptions);
    for (int i = 0; i < 5; ++i) {
      say(desk, kEye, 1 + 0.05 * i);
      desk.due(1 + 0.05 * i);
    }
    EXPECT_FALSE(is_hover(desk.stream().sent()));
    EXPECT_TRUE(desk.control(what));
    EXPECT_TRUE(is_hover(desk.due(1.21)->command));
    const auto refused = say(desk, kEye, 1.22);
    if (what == SwitchControl::TakeOver) {
      EXPECT_EQ(refused, Refused::Locked);
    } else if (what == SwitchControl::EmergencyStop) {
      EXPECT_EQ(refused, Refused::Stopped);
    } else {
      EXPECT_FALSE(refused);
    }
  }
}

TEST(CommandDesk, ZeroesALockedOwnerThatIsGoneAndGivesControlToNobody) {
  CommandDesk desk(kOptions);
  EXPECT_FALSE(desk.control(SwitchControl::Lock));
  for (int i = 0; i < 5; ++i) {
    say(desk, kEye, 1 + 0.05 * i);
    desk.due(1 + 0.05 * i);
  }
  EXPECT_TRUE(desk.control(SwitchControl::Lock));
  desk.due(1.21);
  say(desk, kEye, 1.25);
  EXPECT_FALSE(is_hover(desk.due(1.25)->command));  // a lock does not stop its owner
  desk.forget(kEye.id.peer, 1.26);
  EXPECT_TRUE(is_hover(desk.due(1.26)->command));
  EXPECT_EQ(say(desk, kGround, 1.3), Refused::Locked);
}

TEST(CommandDesk, IsClosedForGood) {
  CommandDesk desk(kOptions);
  say(desk, kEye, 1);
  desk.due(1);
  desk.close();
  EXPECT_TRUE(is_hover(desk.due(1.01)->command));
  EXPECT_FALSE(desk.control(SwitchControl::Reset));
  EXPECT_EQ(say(desk, kEye, 1.02), Refused::Stopped);
}

// Whatever two sources say when: between setpoints of one and of the other stands an exact zero.
TEST(CommandDesk, NeverInterleavesWithoutAZero) {
  test::Random random("command desk");
  CommandDesk desk(kOptions);
  const Claimant all[] = {kGround, kEye, kScript};
  const double speeds_m_s[] = {0.3, -0.3, 0.3};
  double now_s = 1, before_m_s = 0;
  for (int i = 0; i < 20000; ++i) {
    now_s += random.uniform(0, 0.03);
    if (random.integer(0, 100) == 0) now_s += 0.6;
    const int who = random.integer(0, 9) == 0 ? random.integer(0, 2) : 1 + i / 500 % 2;
    desk.heartbeat(all[who], now_s);
    say(desk, all[who], now_s, speeds_m_s[who]);
    if (const auto sent = desk.due(now_s)) {
      EXPECT_GE(sent->command.forward_m_s * before_m_s, 0);  // never over to the other sign
      before_m_s = sent->command.forward_m_s;
    }
  }
}

TEST(SwitchControl, HasFiveNumbers) {
  for (int number = 0; number < 65536; ++number) {
    ASSERT_EQ(is_switch_control(std::uint16_t(number)), number >= 31010 && number <= 31014);
  }
}

}  // namespace
}  // namespace kestrel
