#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include <httplib.h>

#include <nlohmann/json.hpp>

#include "kestrel/ground/ground_station.hpp"
#include "kestrel/ground/stream_frame.hpp"
#undef _res  // a macro of resolv.h

namespace kestrel::test {

using Json = nlohmann::json;

/// A viewer of a station on this machine.
class StationClient {
 public:
  StationClient(const GroundStation& station, const AccessToken& token)
      : page_("127.0.0.1", station.port()),
        commands_("127.0.0.1", station.command_port()),
        stops_("127.0.0.1", station.stop_port()),
        bearer_("Bearer " + token.text()) {}

  httplib::Result get(const std::string& path) { return page_.Get(path); }

  httplib::Response post(const std::string& body, httplib::Headers more = {}) {
    more.emplace("Authorization", bearer_);
    const auto answer = commands_.Post("/command", more, body, "application/json");
    return answer ? *answer : httplib::Response{};
  }

  /// The emergency stop, at its own port.
  httplib::Response stop(httplib::Headers more = {}) {
    more.emplace("Authorization", bearer_);
    const auto answer = stops_.Post("/stop", more, "", "text/plain");
    return answer ? *answer : httplib::Response{};
  }
  int stop_port_gives(const std::string& path) { return stops_.Get(path)->status; }

  Json status() { return Json::parse(page_.Get("/status", {{"Authorization", bearer_}})->body); }

  std::string join() { return Json::parse(post(R"({"do":"join"})").body)["client"]; }

  int preflight(const std::string& origin) {
    return commands_.Options("/command", {{"Origin", origin}})->status;
  }

  int stream_status() {
    const auto answer = page_.Get("/stream", {{"Authorization", bearer_}});
    return answer ? answer->status : -1;
  }

  /// Reads frames until look is false, while show is called again and again.
  void watch(const std::function<bool(const StreamFrame&)>& look,
             const std::function<void()>& show) {
    std::atomic<bool> done{false};
    std::thread shower([&] {
      while (!done) {
        show();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
    StreamReader reader;
    page_.Get("/stream", {{"Authorization", bearer_}}, [&](const char* data, std::size_t size) {
      reader.add({data, size});
      while (const auto frame = reader.next()) {
        if (!look(*frame)) return false;
      }
      return true;
    });
    done = true;
    shower.join();
  }

 private:
  httplib::Client page_;
  httplib::Client commands_;
  httplib::Client stops_;
  std::string bearer_;
};

}  // namespace kestrel::test
