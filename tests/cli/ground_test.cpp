// The ground station as an operator meets it: the real program flies the simulator, a real browser
// shows its page, and what goes out is heard at the other end of the link.
#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/ground_visit.hpp"

namespace kestrel::test {
namespace {

using Ground = GroundVisit;

TEST_F(Ground, AnOperatorStartsHoldsAViewAborts) {
  ASSERT_TRUE(comes([&] { return frame() > 0; })) << browser_->text("line");
  const int before = frame();
  EXPECT_TRUE(comes([&] { return frame() > before; })) << "the picture stands still";
  EXPECT_TRUE(says("sight", "Target seen"));
  EXPECT_TRUE(comes([&] { return vehicle_.heard() > 10; }));
  EXPECT_EQ(vehicle_.fastest(), 0) << "it moves before Start";

  browser_->click("take");
  ASSERT_TRUE(says("answer", "you have the command"));
  ASSERT_TRUE(comes([&] {
    return browser_->run("return !document.getElementById('start').disabled") == "true";
  }));
  browser_->click("start");
  ASSERT_TRUE(says("answer", "servoing"));
  EXPECT_TRUE(comes([&] { return vehicle_.speed() > 0.05; }));
  EXPECT_TRUE(says("mode", "Servoing"));

  browser_->click("hold_view");
  EXPECT_TRUE(says("answer", "is the goal"));
  EXPECT_TRUE(says("events", "is the goal"));
  // The helicopter brakes and comes back to where it was asked: the command falls to almost none.
  EXPECT_TRUE(comes([&] { return vehicle_.speed() < 0.05; }));
  EXPECT_TRUE(says("mode", "Servoing"));

  browser_->click("abort");
  ASSERT_TRUE(says("answer", "aborted"));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  vehicle_.fastest();
  const long heard = vehicle_.heard();
  EXPECT_TRUE(comes([&] { return vehicle_.heard() > heard + 20; }));
  EXPECT_EQ(vehicle_.fastest(), 0) << "an abort stays";
  EXPECT_TRUE(says("mode", "ABORTED"));
  EXPECT_EQ(browser_->run("return document.getElementById('start').disabled"), "true");
}

TEST_F(Ground, AnOperatorDrawsANewTemplate) {
  ASSERT_TRUE(comes([&] { return frame() > 0; })) << browser_->text("line");
  browser_->click("take");
  ASSERT_TRUE(says("answer", "you have the command"));
  ASSERT_TRUE(comes([&] {
    return browser_->run("return !document.getElementById('freeze').disabled") == "true";
  }));
  const auto at = nlohmann::json::parse(
      browser_->run("const b = document.getElementById('picture').getBoundingClientRect();"
                    "return [b.left, b.top, b.width, b.height]"));
  const auto place = [&](double share, int axis) {
    return int(at[std::size_t(axis)].get<double>() +
               share * at[std::size_t(axis) + 2].get<double>());
  };
  browser_->drag(place(0.35, 0), place(0.35, 1), place(0.65, 0), place(0.65, 1));
  ASSERT_TRUE(says("verdict", "keypoints")) << browser_->text("answer");
  browser_->click("use");
  ASSERT_TRUE(says("events", "new template")) << browser_->text("answer");
  EXPECT_TRUE(says("sight", "Target seen"));
  program_->signal(SIGINT);
  const Outcome outcome = program_->wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / "report.html"));
  EXPECT_EQ(outcome.err.find("token="), std::string::npos) << "a token of a file is not printed";
}

}  // namespace
}  // namespace kestrel::test
