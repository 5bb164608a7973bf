#include "kestrel/lab/order_of_accuracy.hpp"

#include <gtest/gtest.h>

#include "lab/lab_setup.hpp"

namespace kestrel {
namespace {

double order(Law law, const AccuracyOptions& options) {
  return order_of_accuracy(test::benchmark_setup("S0_tutorial", law, 1), options).value_or(-1);
}

TEST(OrderOfAccuracy, IsTwoForOneMatrixAndThreeForTheMeanOfTwo) {
  // Three printed digits.
  EXPECT_NEAR(order(Law::Cur, {}), 1.995, 6e-4);
  EXPECT_NEAR(order(Law::Des, {}), 2.004, 6e-4);
  EXPECT_NEAR(order(Law::Mean, {}), 2.994, 6e-4);
}

TEST(OrderOfAccuracy, IsEmptyWhereTheLawAnswersNothing) {
  CameraSetup setup = test::benchmark_setup("S0_tutorial", Law::Mean, 1);
  setup.scenario.points_m.resize(2);
  EXPECT_FALSE(order_of_accuracy(setup, {}));
}

}  // namespace
}  // namespace kestrel
