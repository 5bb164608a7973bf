// A hand at the page: sticks by mouse and keyboard, what lets go of them, and a line that is cut.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/ground_visit.hpp"

namespace kestrel::test {
namespace {

using nlohmann::json;

class Hand : public GroundVisit {
 protected:
  struct Place {
    int x = 0;
    int y = 0;
  };

  /// A place of a stick, by its shares to the right and up, px of the window.
  Place on_pad(const std::string& id, double right, double up) {
    browser_->run("document.getElementById('" + id + "').scrollIntoView({block: 'center'})");
    const auto box = json::parse(browser_->run("const b = document.getElementById('" + id +
                                               "').getBoundingClientRect();"
                                               "return [b.left, b.top, b.width]"));
    const double width = box[2];
    return {int(double(box[0]) + width * (0.5 + 0.36 * right)),
            int(double(box[1]) + width * (0.5 - 0.36 * up))};
  }
  void press_pad(const std::string& id, double right, double up) {
    const Place place = on_pad(id, right, up);
    browser_->press(place.x, place.y);
  }
  bool moves(const std::function<bool(const VelocityCommand&)>& so) {
    return comes([&] { return so(vehicle_.command()); });
  }
  bool hovers() {
    return moves([](const VelocityCommand& c) { return c.vector().isZero(0); });
  }
};

TEST_F(Hand, TakesTheVehicleWithTheMouseAndLetsGo) {
  take_command();
  browser_->click("start");
  ASSERT_TRUE(says("mode", "Servoing"));
  ASSERT_TRUE(moves([](const VelocityCommand& c) { return c.vector().norm() > 0.05; }));
  press_pad("pad_move", 0.5, 0);
  EXPECT_TRUE(says("mode", "By hand"));
  EXPECT_TRUE(moves([](const VelocityCommand& c) {
    return c.right_m_s > 0.5 && std::abs(c.forward_m_s) < 0.2 && c.down_m_s == 0;
  })) << vehicle_.command().vector().transpose();
  EXPECT_TRUE(says("sticks_asked", "m/s"));
  browser_->let_go();
  EXPECT_TRUE(hovers());
  EXPECT_TRUE(says("mode", "Hover")) << "not back to the law by itself";
  press_pad("pad_turn", 0.6, 0.6);
  EXPECT_TRUE(moves([](const VelocityCommand& c) {
    return c.yaw_rate_rad_s > 0.1 && c.down_m_s < -0.1 && c.forward_m_s == 0;
  })) << vehicle_.command().vector().transpose();
  browser_->run("window.dispatchEvent(new Event('blur'))");
  EXPECT_TRUE(hovers()) << "a page that nobody looks at";
}

TEST_F(Hand, SteersWithTheKeyboardAlone) {
  take_command();
  browser_->key_down("g");
  browser_->key_up("g");
  ASSERT_TRUE(is_true("document.activeElement.id === 'dead_man'"));
  browser_->key_down("w");
  browser_->key_up("w");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_TRUE(vehicle_.command().vector().isZero(0)) << "no key steers without the dead man";
  browser_->key_down(" ");
  ASSERT_TRUE(says("mode", "By hand"));
  browser_->key_down("w");
  EXPECT_TRUE(moves([](const VelocityCommand& c) { return c.forward_m_s > 0.3; }));
  browser_->key_up("w");
  browser_->key_down("q");
  EXPECT_TRUE(moves(
      [](const VelocityCommand& c) { return c.yaw_rate_rad_s < -0.1 && c.forward_m_s == 0; }));
  browser_->key_up(" ");
  EXPECT_TRUE(hovers());
}

TEST_F(Hand, WhoseBrowserDiesLetsGo) {
  take_command();
  press_pad("pad_move", 0, 0.8);
  ASSERT_TRUE(moves([](const VelocityCommand& c) { return c.forward_m_s > 0.5; }));
  const double crash_s = now_s();
  browser_->crash();
  ASSERT_TRUE(comes([&] { return vehicle_.stopped_s() > crash_s; }));
  std::printf("browser killed with the sticks held -> first zero on the wire: %.3f s\n",
              vehicle_.stopped_s() - crash_s);
  vehicle_.fastest();
  const long heard = vehicle_.heard();
  EXPECT_TRUE(comes([&] { return vehicle_.heard() > heard + 20; }));
  EXPECT_EQ(vehicle_.fastest(), 0);
}

TEST_F(Hand, IsToldWhenTheLineIsCutAndWhenItIsBack) {
  take_command();
  program_->signal(SIGSTOP);
  EXPECT_TRUE(says("mode", "no connection"));
  EXPECT_TRUE(says("line", "no word from the program"));
  program_->signal(SIGCONT);
  EXPECT_TRUE(says("line", "live"));
  EXPECT_TRUE(says("mode", "Hover"));
  program_->signal(SIGKILL);
  program_->wait();
  EXPECT_TRUE(says("mode", "no connection"));
  start_program();
  EXPECT_TRUE(says("line", "live")) << "it comes back by itself";
  browser_->click("take");
  EXPECT_TRUE(says("answer", "you have the command"));
}

TEST_F(Hand, ChoosesLawLimitsAndGoalByNumbers) {
  take_command();
  browser_->run(
      "const l = document.getElementById('law'); l.value = 'des';"
      "l.dispatchEvent(new Event('change'))");
  EXPECT_TRUE(says("events", "law des"));
  const auto write = [&](const std::string& id, const std::string& number) {
    browser_->run("const i = document.getElementById('" + id + "'); i.value = '" + number +
                  "'; i.dispatchEvent(new Event('input', {bubbles: true}))");
  };
  write("most_forward", "99");
  browser_->click("set_limits");
  EXPECT_TRUE(says("answer", "at most"));
  write("most_forward", "0.4");
  browser_->click("set_limits");
  EXPECT_TRUE(says("events", "at most 0.4 m/s forward"));
  write("goal_forward", "3");
  browser_->click("set_goal");
  EXPECT_TRUE(says("answer", "not be wholly in the picture"));
  write("goal_forward", "-6");
  write("goal_right", "0.5");
  browser_->click("set_goal");
  EXPECT_TRUE(says("events", "goal -6.00 m forward"));
  browser_->click("start");
  EXPECT_TRUE(moves([](const VelocityCommand& c) { return c.forward_m_s > 0.1; }));
  EXPECT_LE(vehicle_.fastest(), 3);
  EXPECT_TRUE(says("map_words", "before it"));
  EXPECT_TRUE(says("horizon_words", "Roll"));
  EXPECT_TRUE(says("link", "a second"));
}

// WCAG 2.1, 1.4.10 (reflow), 2.1.1 (keyboard), 4.1.2 (names).
TEST_F(Hand, FindsEverythingOnANarrowScreenAndByKeyboard) {
  ASSERT_TRUE(comes([&] { return frame() > 0; }));
  browser_->screen(360, 740);
  EXPECT_TRUE(is_true("document.documentElement.scrollWidth <= innerWidth && innerWidth === 360"))
      << browser_->run("return [document.documentElement.scrollWidth, innerWidth]");
  const std::string nameless = browser_->run(
      "return [...document.querySelectorAll('button,input,select,canvas')].filter(e =>"
      "  !(e.getAttribute('aria-label') || e.textContent.trim() || (e.labels && e.labels.length)))"
      "  .map(e => e.id)");
  EXPECT_EQ(nameless, "[]");
  const std::string unreachable = browser_->run(
      "return [...document.querySelectorAll('button,input,select')].filter(e => {"
      "  if (e.disabled || e.hidden || !e.offsetParent) return false;"
      "  e.focus(); return document.activeElement !== e; }).map(e => e.id)");
  EXPECT_EQ(unreachable, "[]");
}

}  // namespace
}  // namespace kestrel::test
