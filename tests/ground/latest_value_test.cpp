#include "kestrel/ground/latest_value.hpp"

#include <thread>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

constexpr double kLong_s = 20;  // never waited out: something comes before

TEST(LatestValue, WhoTakesLateGetsTheNewest) {
  LatestValue<int> place;
  EXPECT_EQ(place.now().value, nullptr);
  EXPECT_EQ(place.now().number, 0u);
  for (int i = 1; i <= 5; ++i) place.put(std::make_shared<const int>(10 * i));
  const auto seen = place.newer_than(2, kLong_s);
  EXPECT_EQ(seen.number, 5u);
  EXPECT_EQ(*seen.value, 50);
}

TEST(LatestValue, NothingNewIsNothing) {
  LatestValue<int> place;
  place.put(std::make_shared<const int>(1));
  EXPECT_EQ(place.newer_than(1, 0.001).value, nullptr);
}

TEST(LatestValue, WakesWhoWaitsWithTheNextValue) {
  LatestValue<int> place;
  std::thread later([&] { place.put(std::make_shared<const int>(7)); });
  const auto seen = place.newer_than(0, kLong_s);
  later.join();
  ASSERT_NE(seen.value, nullptr);
  EXPECT_EQ(*seen.value, 7);
}

TEST(LatestValue, ClosingWakesWhoWaitsWithNothing) {
  LatestValue<int> place;
  place.put(std::make_shared<const int>(7));
  std::thread later([&] { place.close(); });
  EXPECT_EQ(place.newer_than(1, kLong_s).value, nullptr);
  later.join();
  EXPECT_TRUE(place.is_closed());
  EXPECT_EQ(place.newer_than(0, kLong_s).value, nullptr);
}

TEST(LatestValue, AValueLivesAsLongAsSomebodyHoldsIt) {
  LatestValue<int> place;
  auto first = std::make_shared<const int>(1);
  const std::weak_ptr<const int> watched = first;
  place.put(std::move(first));
  {
    const auto held = place.now();
    place.put(std::make_shared<const int>(2));
    EXPECT_FALSE(watched.expired());
  }
  EXPECT_TRUE(watched.expired());
}

}  // namespace
}  // namespace kestrel
