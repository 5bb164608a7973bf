// The page under fingers: a tablet and a telephone, without mouse or keyboard.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/ground_visit.hpp"

namespace kestrel::test {
namespace {

using nlohmann::json;

class Touch : public GroundVisit {
 protected:
  void screen(int width, int height) {
    browser_->touch_screen(width, height);
    browser_->run("location.reload()");  // what has a pointer is asked when a page is made
    ASSERT_TRUE(
        is_true("document.readyState === 'complete' && matchMedia('(pointer:coarse)')"
                ".matches && innerWidth === " +
                std::to_string(width)));
    ASSERT_TRUE(comes([&] { return frame() > 0; })) << browser_->text("line");
    ASSERT_TRUE(tap("take", "answer", "you have the command")) << browser_->text("answer");
    ASSERT_TRUE(is_true("!document.getElementById('dead_man').disabled"));
  }
  /// Taps until it has worked: on a busy machine a tap may last so long that it is none.
  bool tap(const std::string& id, const std::string& where, const std::string& words) {
    for (int tries = 0; tries < 6; ++tries) {
      browser_->tap(id);
      if (comes([&] { return browser_->text(where).find(words) != std::string::npos; }, 5))
        return true;
    }
    return false;
  }
  /// A place of an element by its shares of width and height, as it lies now.
  Finger on(const std::string& element, double right, double down, int id = 0) {
    const auto box = json::parse(browser_->run("const b = document.getElementById('" + element +
                                               "').getBoundingClientRect();"
                                               "return [b.left, b.top, b.width, b.height]"));
    return {id, double(box[0]) + right * double(box[2]), double(box[1]) + down * double(box[3])};
  }
  void show(const std::string& element) {
    browser_->run("document.getElementById('" + element + "').scrollIntoView({block: 'center'})");
  }
  /// How far the page is scrolled and how much it is enlarged.
  std::string view() { return browser_->run("return [Math.round(scrollY), visualViewport.scale]"); }
  bool moves(const std::function<bool(const VelocityCommand&)>& so) {
    return comes([&] { return so(vehicle_.command()); });
  }
};

TEST_F(Touch, AFingerDrawsATemplate) {
  screen(768, 1024);
  show("picture");
  const std::string before = view();
  // Taken away by the system, as by a call that comes in: nothing was drawn, and it is live again.
  browser_->touch("touchStart", {on("picture", 0.3, 0.3)});
  browser_->touch("touchMove", {on("picture", 0.5, 0.6)});
  browser_->touch("touchCancel", {});
  EXPECT_TRUE(is_true("drag === null && frozen === null"));
  // Two fingers that go apart neither enlarge the page nor draw twice: the first one draws.
  browser_->touch("touchStart", {on("picture", 0.45, 0.45), on("picture", 0.55, 0.55, 1)});
  browser_->touch("touchMove", {on("picture", 0.35, 0.35), on("picture", 0.65, 0.65, 1)});
  EXPECT_EQ(view(), before);
  browser_->touch("touchEnd", {});
  EXPECT_TRUE(is_true("drag === null"));
  ASSERT_TRUE(says("verdict", "keypoints")) << browser_->text("answer");
  browser_->run("goLive(); return 0");
  show("picture");
  const std::string again = view();

  browser_->touch("touchStart", {on("picture", 0.35, 0.35)});
  for (const double share : {0.45, 0.55, 0.65}) {
    browser_->touch("touchMove", {on("picture", share, share)});
  }
  EXPECT_EQ(view(), again) << "the page must not go along";
  browser_->touch("touchEnd", {});
  ASSERT_TRUE(says("verdict", "keypoints")) << browser_->text("answer");
  EXPECT_TRUE(tap("use", "events", "new template")) << browser_->text("answer");
}

TEST_F(Touch, TwoFingersFlyAndEachLetsGoOfItsOwnStick) {
  screen(360, 740);
  show("sticks");
  EXPECT_TRUE(is_true("document.getElementById('picture').getBoundingClientRect().top >= 0"))
      << "who flies sees the picture";
  const Finger right = on("pad_move", 0.7, 0.5, 1);
  const Finger up = on("pad_turn", 0.5, 0.3, 2);
  browser_->touch("touchStart", {right});
  EXPECT_TRUE(says("mode", "By hand"));
  EXPECT_TRUE(moves([](const VelocityCommand& c) { return c.right_m_s > 0.3; }));
  browser_->touch("touchStart", {right, up});
  EXPECT_TRUE(moves([](const VelocityCommand& c) {
    return c.right_m_s > 0.3 && c.down_m_s < -0.1;
  })) << vehicle_.command().vector().transpose();
  const std::string before = view();
  browser_->touch("touchMove", {{1, right.x, right.y - 25}, {2, up.x, up.y}});
  EXPECT_TRUE(moves([](const VelocityCommand& c) { return c.forward_m_s > 0.2; }));
  EXPECT_EQ(view(), before) << "a finger that steers scrolls nothing";
  browser_->touch("touchEnd", {up});
  EXPECT_TRUE(moves([](const VelocityCommand& c) { return c.down_m_s == 0 && c.right_m_s > 0.3; }))
      << vehicle_.command().vector().transpose();
  EXPECT_TRUE(says("mode", "By hand"));
  browser_->touch("touchCancel", {});
  EXPECT_TRUE(moves([](const VelocityCommand& c) { return c.vector().isZero(0); }));
  EXPECT_TRUE(says("mode", "Hover"));
}

// WCAG 2.1: 2.5.5 (targets of 44 px), 1.4.3 (contrast of 4.5 of all text that is shown, against the
// nearest ground that is not transparent), 1.4.13 (nothing is told by hovering alone).
TEST_F(Touch, EverythingIsLargeAndPlainEnough) {
  screen(360, 740);
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('button,input,select,summary')]"
                          ".filter(e => e.offsetParent).filter(e => {"
                          "  const b = e.getBoundingClientRect();"
                          "  return b.width < 44 || b.height < 44; }).map(e => e.id)"),
            "[]");
  EXPECT_EQ(
      browser_->run("document.getElementById('legend').open = true;"
                    "const part = x => (x /= 255) <= 0.04045 ? x / 12.92"
                    "  : Math.pow((x + 0.055) / 1.055, 2.4);"
                    "const light = c => 0.2126 * part(c[0]) + 0.7152 * part(c[1])"
                    "  + 0.0722 * part(c[2]);"
                    "const rgba = s => (s.match(/[0-9.]+/g) || [0, 0, 0, 0]).map(Number);"
                    "const ground = e => { for (; e; e = e.parentElement) {"
                    "  const c = rgba(getComputedStyle(e).backgroundColor);"
                    "  if (c.length < 4 || c[3] === 1) return c; } return [255, 255, 255]; };"
                    "return [...document.querySelectorAll('body *')].filter(e =>"
                    "  e.offsetParent && [...e.childNodes].some(n => n.nodeType === 3 &&"
                    "  n.data.trim())).filter(e => {"
                    "  const a = light(rgba(getComputedStyle(e).color)), b = light(ground(e));"
                    "  return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5; })"
                    "  .map(e => e.id || e.textContent)"),
      "[]");
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('[title]')].filter(e =>"
                          "  !e.title.startsWith('Key: ')).map(e => e.id)"),
            "[]")
      << "told by hovering alone";
  EXPECT_TRUE(is_true("document.documentElement.scrollWidth <= innerWidth"));
}

}  // namespace
}  // namespace kestrel::test
