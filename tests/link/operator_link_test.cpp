#include "kestrel/link/operator_link.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "kestrel/link/command_receiver.hpp"

#include "link/loopback.hpp"
#include "link/running_switch.hpp"

namespace kestrel {
namespace {

using test::monotonic_s;
using test::RunningSwitch;

constexpr double kUnixAtZero_s = 1.8e9;  // as RunningSwitch's clock of the wall

/// A switch whose link 2 is a ground station's over UDP, and flight control behind it.
class Operator : public testing::Test {
 protected:
  SwitchLoopOptions options() { return test::quick_switch(flight_.local()); }

  /// True as soon as the condition is, while the link is looked after.
  template <class Condition>
  bool comes(OperatorLink& link, const Condition& condition, double within_s = 20) {
    for (const double end_s = monotonic_s() + within_s; monotonic_s() < end_s;) {
      link.look_after();
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
  bool is(OperatorLink& link, ControlState state) {
    return comes(link, [&] {
      const OperatorStatus now = link.status();
      return now.control && now.control->state == state && now.open.empty();
    });
  }
  bool flies(OperatorLink& link, double forward_m_s) {
    return comes(link, [&] {
      link.send({forward_m_s, 0, 0, 0}, 0);
      for (const ReceivedCommand& received : flight_.poll(0.001)) last_ = received.command;
      return std::abs(last_.forward_m_s - forward_m_s) < 1e-6;
    });
  }

  CommandReceiver flight_{Address{"127.0.0.1", 0}};
  VelocityCommand last_;
};

TEST_F(Operator, TakesOverFliesAndReleases) {
  RunningSwitch running(options());
  OperatorLink link(running.address(2), {});
  link.take_over();
  EXPECT_TRUE(is(link, ControlState::TakenOver));
  EXPECT_TRUE(flies(link, 0.3));
  link.release();
  EXPECT_TRUE(is(link, ControlState::Hold)) << words(link.status());
  EXPECT_FALSE(link.status().holds);
  EXPECT_EQ(link.failures(), 0);
}

TEST_F(Operator, StopsAndResets) {
  RunningSwitch running(options());
  OperatorLink link(running.address(2), {});
  link.stop();
  EXPECT_TRUE(is(link, ControlState::Stopped));
  link.reset();
  EXPECT_TRUE(comes(link, [&] { return link.status().control->state != ControlState::Stopped; }));
}

TEST_F(Operator, WhoEndsGivesTheVehicleBack) {
  RunningSwitch running(options());
  {
    OperatorLink link(running.address(2), {});
    link.take_over();
    ASSERT_TRUE(is(link, ControlState::TakenOver));
  }
  OperatorLink next(running.address(2), {});
  EXPECT_TRUE(comes(next, [&] { return next.status().control.has_value(); }));
  EXPECT_NE(next.status().control->state, ControlState::TakenOver);
}

TEST_F(Operator, IsRefusedOnALinkOfAnotherRole) {
  RunningSwitch running(options());
  OperatorLink link(running.address(3), {});  // a script's
  link.take_over();
  EXPECT_TRUE(comes(link, [&] { return !link.status().holds; }));
  EXPECT_NE(link.take_words().at(0).find("refused"), std::string::npos);
}

TEST_F(Operator, ASignedLinkIsHeardWithTheKeyOnly) {
  const mavlink::SigningKey key = mavlink::random_key();
  SwitchLoopOptions signing = options();
  signing.core.links[2].key = key;
  RunningSwitch running(signing);
  OperatorLinkOptions with;
  with.key = key;
  EXPECT_THROW(OperatorLink(running.address(2), with), std::invalid_argument) << "no clock";
  with.unix_s = [] { return kUnixAtZero_s + monotonic_s(); };
  OperatorLink link(running.address(2), with);
  link.stop();
  EXPECT_TRUE(is(link, ControlState::Stopped));
  OperatorLink without(running.address(2), {});
  with.key = mavlink::random_key();
  OperatorLink other(running.address(2), with);
  without.reset();
  other.reset();
  EXPECT_TRUE(comes(link, [&] {  // both are given up
    without.look_after();
    other.look_after();
    return without.status().open.empty() && other.status().open.empty();
  }));
  EXPECT_FALSE(other.status().is_heard) << "what is signed by another key is not believed";
  EXPECT_EQ(link.status().control->state, ControlState::Stopped);
}

TEST_F(Operator, NobodyAtTheOtherEndIsCounted) {
  OperatorLink link(test::deaf_port(), {});
  EXPECT_TRUE(comes(link, [&] {
    link.zero();
    return link.failures() > 0;
  }));
  EXPECT_FALSE(link.status().is_heard);
}

TEST(OperatorLinkOptions, NameWhatIsOutOfRange) {
  OperatorLinkOptions options;
  options.system_id = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.component_id = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
