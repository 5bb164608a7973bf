// The part of GroundDesk that speaks to a switch by a link of the operator's own: a real switch
// over loopback, of which this test is flight control.
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "kestrel/ground/ground_desk.hpp"
#include "kestrel/link/autopilot_link.hpp"
#include "kestrel/link/command_link.hpp"
#include "kestrel/link/command_receiver.hpp"

#include "ground/desk_viewer.hpp"
#include "link/running_switch.hpp"

namespace kestrel {
namespace {

// Slow, so that the limits of acceleration are soon through with them.
const VelocityCommand kForward{0.08, 0, 0, 0};
const VelocityCommand kRight{0, 0.06, 0, 0};
const VelocityCommand kDown{0, 0, 0.04, 0};

/// A desk whose law goes by the switch's vision link, and whose hand by a ground link.
class DeskAtASwitch : public testing::Test {
 protected:
  DeskAtASwitch() {
    client_ = desk_.handle(asked(Ask::Join), 0).client;
    give(Ask::Take);
  }

  SwitchLoopOptions options() {
    SwitchLoopOptions options = test::quick_switch(flight_.local());
    options.core.links[3].priority = 70;  // a script above vision and below the ground
    return options;
  }

  OperatorLink another_station() const {
    OperatorLinkOptions options;
    options.component_id = 191;
    return {switch_->address(2), options};
  }

  GroundCommand asked(Ask ask) {
    GroundCommand command;
    command.ask = ask;
    command.client = client_;
    command.number = ++number_;
    return command;
  }
  Answer give(Ask ask) { return desk_.handle(asked(ask), link_clock_s()).answer; }
  void push(const VelocityCommand& wanted) {
    GroundCommand sticks = asked(Ask::Sticks);
    sticks.velocity = wanted;
    desk_.handle(sticks, link_clock_s());
  }

  /// A frame: what the law wants goes through the desk and the gate; the watchman looks after all.
  void frame() {
    const double now_s = link_clock_s();
    Decision law;
    law.command = law.wanted = kRight;
    law.state = CommandState::Servo;
    law.next.stamp_s = now_s;
    const Decision flown = desk_.steered(law, before_, now_s);
    before_ = flown.next;
    gate_.send(flown.command, now_s);
    desk_.look_after(now_s);
    for (const ReceivedCommand& received : flight_.poll(0.002)) flown_ = received.command;
  }

  /// True as soon as it is, while frames come and a hand, when it holds, asks to go forward.
  template <class Condition>
  bool comes(const Condition& condition, double within_s = 20) {
    for (const double end_s = link_clock_s() + within_s; link_clock_s() < end_s;) {
      if (desk_.mode() == FlightMode::Sticks) push(kForward);
      if (speaks_) script_->send(kDown, link_clock_s());
      frame();
      if (condition()) return true;
    }
    return false;
  }
  bool flies(const VelocityCommand& command) {
    return comes([&] { return (flown_.vector() - command.vector()).norm() < 1e-6; });
  }
  bool hears() {
    return comes([&] { return desk_.status().way.words.find("not heard") == std::string::npos; });
  }
  bool says(const std::string& words) {
    return comes([&] { return desk_.status().way.words.find(words) != std::string::npos; });
  }
  bool told(const std::string& words) {
    return comes([&] {
      for (const GroundEvent& event : desk_.status().events) {
        if (event.words.find(words) != std::string::npos) return true;
      }
      return false;
    });
  }

  CommandReceiver flight_{Address{"127.0.0.1", 0}};
  std::unique_ptr<test::RunningSwitch> switch_ = std::make_unique<test::RunningSwitch>(options());
  CommandLink vision_{switch_->address(1)};
  OperatorLink hand_{switch_->address(2), {}};
  std::unique_ptr<CommandLink> script_ =
      std::make_unique<CommandLink>(switch_->address(3), LinkOptions{{}, 1, 77});
  const Task task_ = test::example_task(test::forward_camera());
  CommandGate gate_{vision_, &hand_};
  GroundDesk desk_{task_, gate_, "run", &hand_};
  DecisionState before_;
  VelocityCommand flown_;
  std::string client_;
  std::uint64_t number_ = 0;
  bool speaks_ = false;  // the script
};

TEST_F(DeskAtASwitch, AHandIsAboveTheScriptThatIsAboveTheLaw) {
  ASSERT_TRUE(hears());
  give(Ask::Start);
  EXPECT_TRUE(flies(kRight));
  speaks_ = true;
  EXPECT_TRUE(flies(kDown)) << "the law does not overrule the script";
  ASSERT_EQ(give(Ask::Grip).kind, Answer::Kind::Done);
  EXPECT_TRUE(flies(kForward)) << "the hand does";
  EXPECT_TRUE(says("taken over by the ground: ground commands"));
  EXPECT_TRUE(told("take-over granted"));
  give(Ask::Hover);
  EXPECT_TRUE(flies(kDown)) << "released: the script has it back";
  EXPECT_TRUE(told("release granted"));
  speaks_ = false;
  EXPECT_TRUE(flies({})) << "and the law hovers until Start";
  give(Ask::Start);
  EXPECT_TRUE(flies(kRight));
}

TEST_F(DeskAtASwitch, TheLawGoesOnBesideTheHandThatTookItsPlace) {
  ASSERT_TRUE(hears());
  give(Ask::Grip);  // from hover: then the law's link hovers
  EXPECT_TRUE(flies(kForward));
  EXPECT_EQ(gate_.counts().zeros, gate_.counts().commands) << "the law had not been started";
  give(Ask::Hover);
  give(Ask::Start);
  EXPECT_TRUE(flies(kRight));
  give(Ask::Grip);
  EXPECT_TRUE(flies(kForward));
  const GateCounts before = gate_.counts();
  comes([&] { return gate_.counts().commands > before.commands + 5; });
  EXPECT_EQ(gate_.counts().zeros, before.zeros) << "its own command goes on on its own link";
}

TEST_F(DeskAtASwitch, AnAbortStopsTheSwitchAndResetEndsIt) {
  ASSERT_TRUE(hears());
  give(Ask::Grip);
  EXPECT_TRUE(flies(kForward));
  give(Ask::Abort);
  EXPECT_TRUE(says("EMERGENCY STOP"));
  EXPECT_TRUE(flies({}));
  EXPECT_TRUE(desk_.status().way.stopped);
  EXPECT_EQ(give(Ask::Start).kind, Answer::Kind::Refused);
  EXPECT_EQ(give(Ask::Reset).kind, Answer::Kind::Done);
  EXPECT_TRUE(comes([&] { return !desk_.status().way.stopped; }));
  EXPECT_TRUE(told("reset granted"));
  EXPECT_EQ(give(Ask::Start).kind, Answer::Kind::Done);
  EXPECT_TRUE(flies(kRight)) << "nothing is left taken over";
}

TEST_F(DeskAtASwitch, AStopOfSomebodyElseIsResetHereAndSetsNothingGoing) {
  ASSERT_TRUE(hears());
  give(Ask::Start);
  EXPECT_TRUE(flies(kRight));
  OperatorLink tower = another_station();
  tower.stop();
  EXPECT_TRUE(comes([&] { return desk_.status().way.stopped; }));
  EXPECT_EQ(desk_.mode(), FlightMode::Hover) << "whoever resets it, the law waits for Start";
  EXPECT_EQ(give(Ask::Grip).kind, Answer::Kind::Refused);
  EXPECT_EQ(give(Ask::Reset).kind, Answer::Kind::Done);
  EXPECT_EQ(desk_.mode(), FlightMode::Hover);
  EXPECT_TRUE(comes([&] { return !desk_.status().way.stopped; }));
}

TEST_F(DeskAtASwitch, ATakeOverThatSomebodyElseEndsIsAHover) {
  ASSERT_TRUE(hears());
  give(Ask::Start);
  give(Ask::Grip);
  EXPECT_TRUE(flies(kForward));
  OperatorLink tower = another_station();
  tower.take_over();
  tower.release();
  for (int i = 0; i < 3; ++i) tower.look_after();
  EXPECT_TRUE(comes([&] {
    tower.look_after();
    return desk_.mode() == FlightMode::Hover;
  }));
  EXPECT_TRUE(flies({}));
}

TEST_F(DeskAtASwitch, AHandThatTheSwitchDoesNotHearFliesNothing) {
  EXPECT_EQ(give(Ask::Grip).kind, Answer::Kind::Refused) << "nothing was heard yet";
  ASSERT_TRUE(hears());
  give(Ask::Start);
  give(Ask::Grip);
  EXPECT_TRUE(flies(kForward));
  switch_->end();
  give(Ask::Grip);
  EXPECT_TRUE(told("the switch does not let the hand fly"));
  EXPECT_EQ(desk_.mode(), FlightMode::Hover) << "doubt means hover";
}

TEST_F(DeskAtASwitch, AHandOnALinkOfAnotherRoleFliesNothing) {
  OperatorLinkOptions other;
  other.component_id = 99;
  OperatorLink wrong(switch_->address(3), other);
  CommandGate gate(vision_, &wrong);
  GroundDesk desk(task_, gate, "other", &wrong);
  const auto until = [&](const auto& condition) {
    for (const double end_s = link_clock_s() + 20; link_clock_s() < end_s;) {
      desk.look_after(link_clock_s());
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  };
  GroundCommand command;
  command.ask = Ask::Join;
  command.client = desk.handle(command, link_clock_s()).client;
  ASSERT_TRUE(until([&] { return wrong.status().is_heard; }));
  for (const Ask ask : {Ask::Take, Ask::Grip}) {
    command.ask = ask;
    ++command.number;
    EXPECT_EQ(desk.handle(command, link_clock_s()).answer.kind, Answer::Kind::Done);
  }
  EXPECT_TRUE(until([&] { return desk.mode() == FlightMode::Hover; }));
  EXPECT_NE(desk.status().events.at(2).words.find("refused"), std::string::npos);
}

}  // namespace
}  // namespace kestrel
