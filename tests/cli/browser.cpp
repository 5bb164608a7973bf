#include "cli/browser.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <httplib.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace kestrel::test {
namespace {

using Json = nlohmann::json;

constexpr int kTries = 300;

Json capabilities() {
  const Json options{{"args",
                      {"--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                       "--window-size=1400,1100"}}};
  // Tests meet certificates that were made a moment ago.
  return {{"capabilities",
           {{"alwaysMatch", {{"goog:chromeOptions", options}, {"acceptInsecureCerts", true}}}}}};
}

Json pointer(const char* type, int x, int y) {
  return {{"type", type}, {"duration", 100}, {"x", x}, {"y", y}};
}

}  // namespace

bool Browser::is_there() {
  return ::access("/usr/bin/chromium", X_OK) == 0 && ::access("/usr/bin/chromedriver", X_OK) == 0;
}

Browser::Browser(int driver_port, const std::filesystem::path& folder) : port_(driver_port) {
  driver_ = std::make_unique<Program>(
      Command{{"chromedriver", "--port=" + std::to_string(driver_port)}}, folder);
  httplib::Client client("127.0.0.1", port_);
  for (int i = 0; i < kTries && !client.Get("/status"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  session_ = Json::parse(call("", capabilities().dump()))["sessionId"];
}

Browser::~Browser() {
  if (session_.empty()) return;
  httplib::Client client("127.0.0.1", port_);
  client.Delete("/session/" + session_);  // ends chromium too
}

std::string Browser::call(const std::string& path, const std::string& body) {
  httplib::Client client("127.0.0.1", port_);
  client.set_read_timeout(120);
  const std::string at = session_.empty() ? "/session" : "/session/" + session_ + path;
  const auto answer = body.empty() ? client.Get(at) : client.Post(at, body, "application/json");
  if (!answer) throw std::runtime_error("the browser's driver does not answer");
  if (answer->status != 200) throw std::runtime_error("browser: " + answer->body.substr(0, 300));
  return Json::parse(answer->body)["value"].dump();
}

void Browser::go(const std::string& address) { call("/url", Json{{"url", address}}.dump()); }

void Browser::click(const std::string& id) {
  // As a human scrolls: to where the page's header, which stays, does not cover it.
  run("document.getElementById('" + id + "').scrollIntoView({block: 'center'})");
  const Json found =
      Json::parse(call("/element", Json{{"using", "css selector"}, {"value", '#' + id}}.dump()));
  const std::string element = found.begin().value();
  call("/element/" + element + "/click", "{}");
}

std::string Browser::run(const std::string& script) {
  return call("/execute/sync", Json{{"script", script}, {"args", Json::array()}}.dump());
}

std::string Browser::text(const std::string& id) {
  return Json::parse(run("return document.getElementById('" + id + "').textContent"));
}

void Browser::drag(int x0, int y0, int x1, int y1) {
  const Json moves{pointer("pointerMove", x0, y0),
                   {{"type", "pointerDown"}, {"button", 0}},
                   pointer("pointerMove", (x0 + x1) / 2, (y0 + y1) / 2),
                   pointer("pointerMove", x1, y1),
                   {{"type", "pointerUp"}, {"button", 0}}};
  const Json hand{{"type", "pointer"}, {"id", "hand"}, {"actions", moves}};
  call("/actions", Json{{"actions", Json::array({hand})}}.dump());
}

void Browser::act(const std::string& actions) {
  call("/actions", "{\"actions\":[" + actions + "]}");
}

void Browser::press(int x, int y) {
  const Json moves{pointer("pointerMove", x, y), {{"type", "pointerDown"}, {"button", 0}}};
  act(Json{{"type", "pointer"}, {"id", "hand"}, {"actions", moves}}.dump());
}

void Browser::slide(int x, int y) {
  const Json moves = Json::array({pointer("pointerMove", x, y)});
  act(Json{{"type", "pointer"}, {"id", "hand"}, {"actions", moves}}.dump());
}

void Browser::let_go() {
  const Json moves = Json::array({Json{{"type", "pointerUp"}, {"button", 0}}});
  act(Json{{"type", "pointer"}, {"id", "hand"}, {"actions", moves}}.dump());
}

void Browser::key_down(const std::string& key) {
  const Json moves = Json::array({Json{{"type", "keyDown"}, {"value", key}}});
  act(Json{{"type", "key"}, {"id", "keyboard"}, {"actions", moves}}.dump());
}

void Browser::key_up(const std::string& key) {
  const Json moves = Json::array({Json{{"type", "keyUp"}, {"value", key}}});
  act(Json{{"type", "key"}, {"id", "keyboard"}, {"actions", moves}}.dump());
}

void Browser::screen(int width, int height) {
  const Json size{{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", true}};
  devtools("Emulation.setDeviceMetricsOverride", size.dump());
}

void Browser::touch_screen(int width, int height) {
  screen(width, height);
  devtools("Emulation.setTouchEmulationEnabled",
           Json{{"enabled", true}, {"maxTouchPoints", 5}}.dump());
}

void Browser::touch(const std::string& what, const std::vector<Finger>& fingers) {
  Json points = Json::array();
  for (const Finger& f : fingers) points.push_back({{"x", f.x}, {"y", f.y}, {"id", f.id}});
  devtools("Input.dispatchTouchEvent", Json{{"type", what}, {"touchPoints", points}}.dump());
}

void Browser::tap(const std::string& id) {
  run("document.getElementById('" + id + "').scrollIntoView({block: 'center'})");
  const Json at = Json::parse(run("const b = document.getElementById('" + id +
                                  "').getBoundingClientRect();"
                                  "return [b.left + b.width / 2, b.top + b.height / 2]"));
  touch("touchStart", {{0, at[0], at[1]}});
  touch("touchEnd", {});
}

void Browser::devtools(const std::string& command, const std::string& parameters) {
  call("/goog/cdp/execute", Json{{"cmd", command}, {"params", Json::parse(parameters)}}.dump());
}

void Browser::crash() {
  try {
    call("/goog/cdp/execute", Json{{"cmd", "Browser.crash"}, {"params", Json::object()}}.dump());
  } catch (const std::runtime_error&) {  // nobody is left to answer
  }
}

std::string Browser::screenshot() { return Json::parse(call("/screenshot", "")); }

}  // namespace kestrel::test
