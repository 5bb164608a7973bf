// What is tried against a ground station: each attack by name is refused and counted, and none
// keeps an operator from stopping the vehicle.
#include <atomic>
#include <deque>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "ground/idle_station.hpp"
#include "ground/raw_connection.hpp"

namespace kestrel {
namespace {

using test::RawConnection;
using test::StationClient;

const std::string kAbort = R"({"do":"abort"})";
const std::string kBegun = "POST /command HTTP/1.1\r\nHost: 127.0.0.1\r\n";

class Attack : public test::IdleStation {
 protected:
  /// Short, so that the tests are.
  std::unique_ptr<GroundStation> impatient() {
    GroundOptions options;
    options.request_s = 0.1;
    return station(options);
  }

  const std::unique_ptr<GroundStation> station_ = station({});
  StationClient client_{*station_, token_};
};

TEST_F(Attack, NoToken) {
  EXPECT_EQ(client_.get("/stream")->status, 401);
  EXPECT_EQ(client_.get("/status")->status, 401);
  EXPECT_EQ(station_->refusals().wrong_token, 2);
}

TEST_F(Attack, WrongToken) {
  StationClient wrong(*station_, random_token());
  EXPECT_EQ(wrong.post(kAbort).status, 401);
  EXPECT_EQ(station_->desk().mode(), FlightMode::Hover);
  EXPECT_EQ(station_->refusals().wrong_token, 1);
}

TEST_F(Attack, ReplayedCommand) {
  const std::string take = R"({"do":"take","client":")" + client_.join() + R"(","number":1})";
  EXPECT_EQ(client_.post(take).status, 200);
  EXPECT_EQ(client_.post(take).status, 425);
  EXPECT_EQ(station_->refusals().stale, 1);
}

TEST_F(Attack, CommandRecordedInAnotherRun) {
  const auto before = station({});
  StationClient then(*before, token_);
  const std::string name = then.join();
  client_.join();
  EXPECT_EQ(client_.post(R"({"do":"take","client":")" + name + R"(","number":1})").status, 410);
}

TEST_F(Attack, CrossSitePost) {
  EXPECT_EQ(client_.post(kAbort, {{"Origin", "http://evil.example"}}).status, 403);
  EXPECT_EQ(client_.post(kAbort, {{"Host", "evil.example"}}).status, 421);
  EXPECT_EQ(station_->desk().mode(), FlightMode::Hover);
  EXPECT_EQ(station_->refusals().foreign, 2);
}

TEST_F(Attack, HugeCommand) {
  EXPECT_EQ(client_.post(std::string(100000, ' ')).status, 413);
  EXPECT_TRUE(comes([&] { return station_->refusals().huge == 1; }));
}

TEST_F(Attack, HeadersWithoutEnd) {
  RawConnection attacker(station_->command_port());
  attacker.send(kBegun);
  const std::string line = "X: " + std::string(1000, 'x') + "\r\n";
  for (int i = 0; i < 1000 && attacker.send(line); ++i) {
  }
  EXPECT_TRUE(comes([&] { return station_->refusals().huge == 1; }));
}

TEST_F(Attack, BodyWithoutEnd) {
  RawConnection attacker(station_->command_port());
  attacker.send(kBegun + "Transfer-Encoding: chunked\r\n\r\n");
  const std::string chunk = "400\r\n" + std::string(1024, ' ') + "\r\n";
  for (int i = 0; i < 1000 && attacker.send(chunk); ++i) {
  }
  EXPECT_TRUE(comes([&] { return station_->refusals().huge == 1; }));
}

TEST_F(Attack, RequestThatDrips) {
  const auto dripped_on = impatient();
  RawConnection attacker(dripped_on->command_port());
  attacker.send(kBegun);
  // Never silent for long: a limit to the silence alone would let it drip for ever.
  EXPECT_TRUE(comes([&] { return !attacker.send("x"); }));
  EXPECT_TRUE(comes([&] { return dripped_on->refusals().slow == 1; }));
  EXPECT_EQ(dripped_on->refusals().malformed, 0) << "counted once";
}

TEST_F(Attack, SilentConnectionIsCutButNoAttack) {
  const auto called = impatient();
  RawConnection early(called->port());  // browsers open one ahead of need
  early.rest(5);
  EXPECT_FALSE(early.is_open());
  EXPECT_EQ(called->refusals().slow, 0);
}

TEST_F(Attack, TwoHundredConnectionsDoNotKeepAnAbortOut) {
  GroundOptions patient;
  patient.request_s = 60;  // so that nothing but their number gives them up
  const auto held = station(patient);
  std::vector<std::unique_ptr<RawConnection>> attackers;
  for (int i = 0; i < 200; ++i) {
    attackers.push_back(std::make_unique<RawConnection>(held->command_port()));
    ASSERT_TRUE(attackers.back()->send(kBegun)) << i;
  }
  EXPECT_EQ(StationClient(*held, token_).post(kAbort).status, 200);
  EXPECT_EQ(held->desk().mode(), FlightMode::Aborted);
  EXPECT_TRUE(comes([&] { return held->refusals().crowded >= 200 - 64; }));
}

TEST_F(Attack, AbortPassesWhileConnectionsKeepComing) {
  std::atomic<bool> done{false};
  std::thread flood([&] {
    std::deque<std::unique_ptr<RawConnection>> held;
    while (!done) {
      held.push_back(std::make_unique<RawConnection>(station_->command_port()));
      held.back()->send(kBegun);
      if (held.size() > 200) held.pop_front();
    }
  });
  EXPECT_TRUE(comes([&] { return station_->refusals().crowded > 100; }));
  EXPECT_EQ(client_.post(kAbort).status, 200);
  done = true;
  flood.join();
  EXPECT_EQ(station_->desk().mode(), FlightMode::Aborted);
}

TEST_F(Attack, FloodedStreamsAndCommandsDoNotTouchTheStop) {
  GroundOptions patient;
  patient.request_s = 60;
  const auto held = station(patient);
  std::vector<std::unique_ptr<RawConnection>> attackers;
  const std::string trusted = "Authorization: Bearer " + token_.text() + "\r\n";
  for (int i = 0; i < 64; ++i) {  // with the token: these are not pushed out
    attackers.push_back(std::make_unique<RawConnection>(held->command_port()));
    attackers.back()->send(kBegun + trusted + "Content-Length: 20\r\n\r\n{");
  }
  for (int i = 0; i < 6; ++i) {
    attackers.push_back(std::make_unique<RawConnection>(held->port()));
    attackers.back()->send("GET /stream HTTP/1.1\r\nHost: 127.0.0.1\r\n" + trusted + "\r\n");
  }
  EXPECT_EQ(StationClient(*held, token_).stop().status, 200);
  EXPECT_EQ(held->desk().mode(), FlightMode::Aborted);
}

TEST_F(Attack, TwoHundredConnectionsDoNotKeepAStopOut) {
  GroundOptions patient;
  patient.request_s = 60;
  const auto held = station(patient);
  std::vector<std::unique_ptr<RawConnection>> attackers;
  for (int i = 0; i < 200; ++i) {
    attackers.push_back(std::make_unique<RawConnection>(held->stop_port()));
    ASSERT_TRUE(attackers.back()->send("POST /stop HTTP/1.1\r\nHost: 127.0.0.1\r\n")) << i;
  }
  EXPECT_EQ(StationClient(*held, token_).stop().status, 200);
  EXPECT_EQ(held->desk().mode(), FlightMode::Aborted);
}

TEST_F(Attack, PageWithAllItsPlacesHeldIsServed) {
  GroundOptions patient;
  patient.request_s = 60;
  const auto held = station(patient);
  std::vector<std::unique_ptr<RawConnection>> attackers;
  for (int i = 0; i < 60; ++i) {
    attackers.push_back(std::make_unique<RawConnection>(held->port()));
    attackers.back()->send("GET / HT");
  }
  EXPECT_EQ(StationClient(*held, token_).get("/")->status, 200);
}

TEST_F(Attack, PathTraversal) {
  long tried = 0;
  for (const char* path : {"/../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/ground.js/../../x",
                           "/..%2f..%2fetc/passwd", "//etc/passwd", "/page/ground.html"}) {
    EXPECT_EQ(client_.get(path)->status, 404) << path;
    EXPECT_EQ(station_->refusals().no_place, ++tried) << path;
  }
}

TEST_F(Attack, MalformedJson) {
  const std::string deep(1000, '[');
  long tried = 0;
  for (const std::string& body :
       {std::string("{\"do\":"), std::string("\0\0", 2), deep, std::string(R"({"do":"fly"})"),
        std::string(R"({"do":"abort","do":7})"),
        std::string(R"({"do":"gain","gain_per_s":1e999})")}) {
    EXPECT_EQ(client_.post(body).status, 400) << body;
    EXPECT_EQ(station_->refusals().malformed, ++tried) << body;
  }
  EXPECT_EQ(station_->desk().mode(), FlightMode::Hover);
}

TEST_F(Attack, WhatIsNoHttp) {
  RawConnection attacker(station_->port());
  attacker.send("\x01\x02\x03 nonsense\r\n\r\n");
  attacker.rest(2);
  EXPECT_TRUE(comes([&] { return station_->refusals().malformed == 1; }));
}

TEST_F(Attack, AThousandRangesOfOneFileAreOneFile) {
  std::string ranges = "bytes=0-";
  for (int i = 0; i < 500; ++i) ranges += ",0-";
  RawConnection attacker(station_->port());
  attacker.send("GET /ground.js HTTP/1.1\r\nHost: 127.0.0.1\r\nRange: " + ranges + "\r\n\r\n");
  EXPECT_LT(attacker.rest(1).size(), 200000u);
}

TEST_F(Attack, TheCountsStandInTheStatus) {
  client_.get("/stream");
  const auto counts = client_.status()["refusals"];
  EXPECT_EQ(counts["wrong_token"], 1);
  EXPECT_EQ(client_.status()["refused"], 1);
}

}  // namespace
}  // namespace kestrel
