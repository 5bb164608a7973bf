#include "kestrel/link/battery.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace kestrel {
namespace {

TEST(Battery, IsReadInItsUnits) {
  mavlink::SysStatus status;
  status.battery_mv = 11100;
  status.battery_10ma = 2400;
  status.battery_percent = 63;
  const Battery battery = battery_of(status);
  EXPECT_DOUBLE_EQ(battery.voltage_v.value(), 11.1);
  EXPECT_DOUBLE_EQ(battery.current_a.value(), 24.0);
  EXPECT_DOUBLE_EQ(battery.charge.value(), 0.63);
  EXPECT_EQ(words(battery), "11.1 V, 24.0 A, 63 %");
}

TEST(Battery, WhatIsNotKnownStaysSo) {
  mavlink::SysStatus status;
  status.battery_mv = std::numeric_limits<std::uint16_t>::max();
  status.battery_10ma = -1;
  status.battery_percent = -1;
  const Battery battery = battery_of(status);
  EXPECT_FALSE(battery.voltage_v);
  EXPECT_FALSE(battery.current_a);
  EXPECT_FALSE(battery.charge);
  EXPECT_FALSE(is_low(battery)) << "nobody is warned of what nobody knows";
  EXPECT_EQ(words(battery), "not known");
  status.battery_percent = 101;
  EXPECT_FALSE(battery_of(status).charge);
  status.battery_mv = 7400;
  EXPECT_EQ(words(battery_of(status)), "7.4 V");
}

// Half a step of the wire either way: 0.5 mV, 5 mA, half a percent.
TEST(Battery, GoesToTheWireAndBack) {
  test::Random random("battery");
  for (int i = 0; i < 200; ++i) {
    const Battery told{random.uniform(0, 60), random.uniform(0, 300), random.uniform(0, 1)};
    const Battery heard = battery_of(sys_status(told));
    EXPECT_NEAR(heard.voltage_v.value(), *told.voltage_v, 0.501e-3);
    EXPECT_NEAR(heard.current_a.value(), *told.current_a, 5.01e-3);
    EXPECT_NEAR(heard.charge.value(), *told.charge, 5.01e-3);
  }
  const Battery nothing = battery_of(sys_status({}));
  EXPECT_FALSE(nothing.voltage_v || nothing.current_a || nothing.charge);
  EXPECT_TRUE(battery_of(sys_status({1e9, 1e9, 7.0})).voltage_v) << "huge, and not 'not known'";
}

TEST(Battery, IsLowBelowAFifth) {
  EXPECT_TRUE(is_low({{}, {}, 0.19}));
  EXPECT_FALSE(is_low({{}, {}, 0.2}));
  EXPECT_FALSE(is_low({{}, {}, 1.0}));
}

TEST(Battery, TheStandInFallsEvenlyWithTheTimeFlown) {
  BatteryOptions options;
  options.endurance_s = 100;
  options.start_charge = 0.8;
  const Battery full = drained(options, 0, options.idle_a);
  EXPECT_DOUBLE_EQ(full.charge.value(), 0.8);
  EXPECT_DOUBLE_EQ(full.voltage_v.value(),
                   options.empty_v + 0.8 * (options.full_v - options.empty_v));
  EXPECT_DOUBLE_EQ(full.current_a.value(), options.idle_a);
  EXPECT_NEAR(drained(options, 25, 1).charge.value(), 0.55, 1e-12);
  EXPECT_EQ(drained(options, 1e6, 1).charge.value(), 0) << "empty is empty";
  EXPECT_EQ(drained(options, 1e6, 1).voltage_v.value(), options.empty_v);
}

TEST(Battery, OptionsOutOfRangeAreNamed) {
  const auto complaint = [](auto change) {
    BatteryOptions options;
    change(options);
    try {
      options.check();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint([](BatteryOptions&) {}), "");
  EXPECT_EQ(complaint([](auto& o) { o.endurance_s = 0; }).rfind("endurance_s", 0), 0u);
  EXPECT_EQ(complaint([](auto& o) { o.full_v = o.empty_v; }).rfind("full_v", 0), 0u);
  EXPECT_EQ(complaint([](auto& o) { o.flying_a = -1; }).rfind("flying_a", 0), 0u);
  EXPECT_EQ(complaint([](auto& o) { o.idle_a = 1e9; }).rfind("idle_a", 0), 0u);
  EXPECT_EQ(complaint([](auto& o) { o.start_charge = 1.1; }).rfind("start_charge", 0), 0u);
}

}  // namespace
}  // namespace kestrel
