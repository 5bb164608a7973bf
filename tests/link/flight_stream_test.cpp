#include "kestrel/link/flight_stream.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

const CommandLimits kEnvelope{{2, 1.5, 1, 0.5235987755982988}, {2, 2, 1.5, 1.05}};
constexpr double kPeriod_s = 0.05;

TEST(FlightStream, StaysInTheEnvelopeAndTheSlewWhateverIsWanted) {
  test::Random random("flight stream");
  FlightStream stream(kEnvelope, kPeriod_s);
  Eigen::Vector4d before = Eigen::Vector4d::Zero();
  double now_s = 10, before_s = now_s;
  stream.next(now_s);
  for (int i = 0; i < 5000; ++i) {
    now_s += random.integer(0, 9) == 0 ? random.uniform(0, 1) : random.uniform(0, 0.05);
    const double size = std::pow(10.0, random.uniform(-3, 30));
    stream.want({{random.normal() * size, random.normal() * size, random.normal() * size,
                  random.normal() * size},
                 now_s},
                now_s + random.uniform(-0.1, 0.5));
    const Eigen::Vector4d sent = stream.next(now_s).command.vector();
    const double span_s = std::min(now_s - before_s, 2 * kPeriod_s);
    const Eigen::Vector4d change = (sent - before).cwiseAbs();
    const Eigen::Vector4d limit = kEnvelope.acceleration.vector() * span_s;
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(sent[k], double(float(sent[k])));
      EXPECT_LE(std::abs(sent[k]), kEnvelope.speed.vector()[k]);
      // The change is right to the rounding of a float below 2.
      EXPECT_TRUE(sent.isZero(0) || change[k] <= limit[k] + 2e-7) << change[k];
    }
    before = sent;
    before_s = now_s;
  }
}

TEST(FlightStream, ArrivesAtWhatIsWanted) {
  FlightStream stream(kEnvelope, kPeriod_s);
  for (double now_s = 0; now_s < 1; now_s += kPeriod_s) {
    stream.want({{1, -0.5, 0.25, 0.125}, now_s - 0.02}, now_s + 0.4);
    const FlightSetpoint sent = stream.next(now_s);
    EXPECT_EQ(sent.captured_s, now_s - 0.02);
    if (now_s > 0.6) {
      EXPECT_EQ(sent.command.vector(), Eigen::Vector4d(1, -0.5, 0.25, 0.125));
    }
  }
}

TEST(FlightStream, IsExactlyZeroFromTheDeadlineOn) {
  FlightStream stream(kEnvelope, kPeriod_s);
  stream.want({{0.1, 0, 0, 0}, 1}, 1.5);
  stream.next(1);
  stream.next(1.1);
  EXPECT_GT(stream.next(1.499).command.forward_m_s, 0);
  EXPECT_TRUE(stream.is_due(1.5));  // although a period has not passed
  EXPECT_TRUE(is_hover(stream.next(1.5).command));
  EXPECT_FALSE(stream.is_due(1.51));
  EXPECT_TRUE(stream.is_due(1.551));
  EXPECT_TRUE(is_hover(stream.next(100).command));
  EXPECT_EQ(stream.sent_count(), 5u);
  EXPECT_EQ(stream.zero_count(), 3u);  // the first, too: it starts from rest
}

TEST(FlightStream, IsZeroAtOnceWhenAsked) {
  FlightStream stream(kEnvelope, kPeriod_s);
  EXPECT_FALSE(stream.is_due(1e6));  // never begun
  stream.want({{0.1, 0, 0, 0}, 1}, 2);
  stream.next(1);
  stream.next(1.1);
  EXPECT_FALSE(is_hover(stream.sent()));
  stream.want_zero();
  EXPECT_TRUE(stream.is_due(1.1));
  EXPECT_TRUE(is_hover(stream.next(1.1).command));
}

TEST(FlightStream, StartsFromRestWhenTheVehicleIsReached) {
  FlightStream stream(kEnvelope, kPeriod_s);
  stream.want({{2, 0, 0, 0}, 1}, 100);
  for (double now_s = 1; now_s < 3; now_s += kPeriod_s) stream.next(now_s);
  EXPECT_EQ(stream.sent().forward_m_s, 2);
  stream.start_from_rest(3);
  EXPECT_NEAR(stream.next(3.01).command.forward_m_s, 0.02, 1e-6);
}

TEST(IsHover, IsExact) {
  EXPECT_TRUE(is_hover({0, -0.0, 0, 0}));
  EXPECT_FALSE(is_hover({0, 0, 0, 1e-300}));
}

}  // namespace
}  // namespace kestrel
