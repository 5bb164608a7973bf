#include "kestrel/ground/flight_mode.hpp"

#include <array>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

constexpr std::array<FlightMode, 4> kModes{FlightMode::Hover, FlightMode::Servo, FlightMode::Sticks,
                                           FlightMode::Aborted};

TEST(FlightMode, OnlyStartLeadsToServo) {
  for (const FlightMode mode : {FlightMode::Hover, FlightMode::Sticks, FlightMode::Aborted}) {
    for (const Ask ask : kAsks) {
      const bool servos = changed(mode, ask).mode == FlightMode::Servo;
      EXPECT_EQ(servos, mode == FlightMode::Hover && ask == Ask::Start)
          << name(mode) << ' ' << name(ask);
    }
  }
}

TEST(FlightMode, AbortIsAlwaysTakenAndOnlyResetEndsIt) {
  for (const FlightMode mode : kModes) {
    EXPECT_EQ(changed(mode, Ask::Abort).mode, FlightMode::Aborted);
    EXPECT_EQ(changed(mode, Ask::Abort).answer.kind, Answer::Kind::Done);
  }
  for (const Ask ask : kAsks) {
    EXPECT_EQ(changed(FlightMode::Aborted, ask).mode,
              ask == Ask::Reset ? FlightMode::Hover : FlightMode::Aborted)
        << name(ask);
  }
  EXPECT_EQ(changed(FlightMode::Aborted, Ask::Start).answer.kind, Answer::Kind::Refused);
}

TEST(FlightMode, OnlyGripLeadsToTheSticksAndNotFromAnAbort) {
  for (const FlightMode mode : kModes) {
    for (const Ask ask : kAsks) {
      const bool by_hand = changed(mode, ask).mode == FlightMode::Sticks;
      const bool stays = mode == FlightMode::Sticks && !is_stop(ask);
      EXPECT_EQ(by_hand, stays || (mode != FlightMode::Aborted && ask == Ask::Grip))
          << name(mode) << ' ' << name(ask);
    }
  }
  EXPECT_EQ(changed(FlightMode::Aborted, Ask::Grip).answer.kind, Answer::Kind::Refused);
  EXPECT_EQ(changed(FlightMode::Sticks, Ask::Start).answer.kind, Answer::Kind::Refused);
  EXPECT_EQ(changed(FlightMode::Sticks, Ask::Hover).mode, FlightMode::Hover);
}

TEST(FlightMode, HoverStopsTheServo) {
  EXPECT_EQ(changed(FlightMode::Servo, Ask::Hover).mode, FlightMode::Hover);
  EXPECT_EQ(changed(FlightMode::Servo, Ask::Hover).answer.kind, Answer::Kind::Done);
  EXPECT_EQ(changed(FlightMode::Servo, Ask::Reset).answer.kind, Answer::Kind::Refused);
}

TEST(FlightMode, HasAWordForEach) {
  EXPECT_STREQ(name(FlightMode::Hover), "hover");
  EXPECT_STREQ(name(FlightMode::Servo), "servo");
  EXPECT_STREQ(name(FlightMode::Sticks), "sticks");
  EXPECT_STREQ(name(FlightMode::Aborted), "aborted");
}

}  // namespace
}  // namespace kestrel
