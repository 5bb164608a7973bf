#include "kestrel/ground/ground_station.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kestrel/ground/stream_frame.hpp"
#include "kestrel/io/image_codec.hpp"

#include "ground/station_client.hpp"
#include "loop/camera_view.hpp"
#include "loop/flight.hpp"

namespace kestrel {
namespace {

using test::Json;
using test::StationClient;

struct Written final : CommandSink {
  std::vector<VelocityCommand> all;
  void send(const VelocityCommand& command, double) noexcept override { all.push_back(command); }
  long failures() const override { return 0; }
};

/// A station on free ports, whose clock stands still.
class Station : public testing::Test {
 protected:
  std::unique_ptr<GroundStation> station(const GroundOptions& options) {
    return std::make_unique<GroundStation>(options, token_, task_, gate_, [] { return 0.0; });
  }
  GroundView view(std::int64_t frame) const {
    GroundView v;
    v.row.frame = frame;
    v.gray = cv::Mat(48, 64, CV_8UC1, cv::Scalar(100));
    v.seen = task_.goal;
    return v;
  }

  const Task task_ = test::example_task(test::forward_camera());
  const AccessToken token_ = random_token();
  Written written_;
  CommandGate gate_{written_};
  std::unique_ptr<GroundStation> station_ = station({});
  StationClient client_{*station_, token_};
};

TEST_F(Station, ServesThePageWithoutATokenAndWithAStrictPolicy) {
  const auto page = client_.get("/");
  ASSERT_EQ(page->status, 200);
  EXPECT_NE(page->body.find("content=\"" + std::to_string(station_->command_port()) + '"'),
            std::string::npos);
  EXPECT_EQ(page->body.find(token_.text()), std::string::npos);
  const std::string policy = page->get_header_value("Content-Security-Policy");
  EXPECT_EQ(policy.find("default-src 'none'"), 0u) << policy;
  EXPECT_EQ(policy.find("unsafe"), std::string::npos) << policy;
  EXPECT_EQ(client_.get("/ground.js")->status, 200);
  EXPECT_EQ(client_.get("/ground.css")->status, 200);
}

TEST_F(Station, ThereIsNoWayToFiles) {
  for (const char* path : {"/../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/ground.js/../../x",
                           "/..%2f..%2fetc/passwd", "//etc/passwd", "/page/ground.html"}) {
    const auto answer = client_.get(path);
    EXPECT_TRUE(answer->status == 404 || answer->status == 400) << path << ' ' << answer->status;
  }
}

TEST_F(Station, StreamsAndCommandsNeedTheToken) {
  EXPECT_EQ(client_.get("/stream")->status, 401);
  StationClient wrong(*station_, random_token());
  EXPECT_EQ(wrong.post(R"({"do":"abort"})").status, 401);
  EXPECT_EQ(station_->desk().mode(), FlightMode::Hover);
  EXPECT_EQ(station_->refusals().wrong_token, 2);
  EXPECT_EQ(client_.post(R"({"do":"abort"})").status, 200);
  EXPECT_EQ(station_->desk().mode(), FlightMode::Aborted);
}

TEST_F(Station, PagesFromElsewhereCannotCommand) {
  const std::string own = "http://127.0.0.1:" + std::to_string(station_->port());
  EXPECT_EQ(client_.post(R"({"do":"abort"})", {{"Origin", "http://evil.example"}}).status, 403);
  EXPECT_EQ(client_.post(R"({"do":"abort"})", {{"Host", "evil.example"}}).status, 421);
  EXPECT_EQ(station_->refusals().foreign, 2);
  EXPECT_EQ(station_->desk().mode(), FlightMode::Hover);
  const auto taken = client_.post(R"({"do":"abort"})", {{"Origin", own}});
  EXPECT_EQ(taken.status, 200);
  EXPECT_EQ(taken.get_header_value("Access-Control-Allow-Origin"), own);
  EXPECT_EQ(client_.preflight("http://evil.example"), 403);
  EXPECT_EQ(client_.preflight(own), 204);
}

TEST_F(Station, WhatIsNoCommandIsRefusedAndCounted) {
  EXPECT_EQ(client_.post("{\"do\":").status, 400);
  EXPECT_EQ(client_.post(R"({"do":"fly"})").status, 400);
  EXPECT_EQ(client_.post(std::string(100000, ' ')).status, 413);
  EXPECT_EQ(station_->refusals().malformed, 2);
}

TEST_F(Station, AReplayedCommandIsRefused) {
  const std::string name = client_.join();
  const std::string take = R"({"do":"take","client":")" + name + R"(","number":1})";
  EXPECT_EQ(client_.post(take).status, 200);
  EXPECT_EQ(client_.post(take).status, 425);
  EXPECT_EQ(client_.post(R"({"do":"take","client":"somebody","number":9})").status, 410);
  EXPECT_EQ(station_->refusals().stale, 1);
}

TEST_F(Station, AFloodOfCommandsIsRefusedButNotAStop) {
  int refused = 0;
  for (int i = 0; i < 60; ++i) refused += client_.post(R"({"do":"join"})").status == 429 ? 1 : 0;
  EXPECT_EQ(refused, 20) << "the clock stands still: a burst of 40, and nothing comes after";
  EXPECT_EQ(client_.post(R"({"do":"abort"})").status, 200);
}

TEST_F(Station, TheStopHasAPortOfItsOwn) {
  EXPECT_NE(client_.get("/")->body.find("content=\"" + std::to_string(station_->stop_port()) + '"'),
            std::string::npos);
  for (int i = 0; i < 100; ++i) client_.post(R"({"do":"join"})");
  EXPECT_EQ(StationClient(*station_, random_token()).stop().status, 401);
  EXPECT_EQ(client_.stop({{"Origin", "http://evil.example"}}).status, 403);
  EXPECT_EQ(client_.stop({{"Host", "evil.example"}}).status, 421);
  EXPECT_EQ(station_->desk().mode(), FlightMode::Hover);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(client_.stop().status, 200) << "at any rate";
  EXPECT_EQ(station_->desk().mode(), FlightMode::Aborted);
  for (const char* path : {"/", "/status", "/stream", "/command", "/stop", "/ground.js"}) {
    EXPECT_EQ(client_.stop_port_gives(path), 404) << path;
  }
}

TEST_F(Station, TheStatusTellsFactsAndTheWayOfAHand) {
  const auto facts = [] {
    return std::vector<Fact>{{"Mode", "GUIDED"},
                             {"Battery", "10.6 V, 7 %: LOW", Fact::Tone::Warning}};
  };
  GroundStation telling(
      {}, token_, task_, gate_, [] { return 0.0; }, facts);
  const Json status = StationClient(telling, token_).status();
  EXPECT_EQ(status["facts"],
            Json::parse(R"([["Mode","GUIDED",""],["Battery","10.6 V, 7 %: LOW","warn"]])"));
  EXPECT_EQ(status["way"]["is_own"], false);
  EXPECT_FALSE(status["way"]["words"].get<std::string>().empty());
}

TEST_F(Station, AFloodOfCommandsHoldsNoHandBackNorDoesAHandFlood) {
  const std::string name = client_.join();
  std::uint64_t number = 0;
  const auto give = [&](const std::string& word, const std::string& more) {
    const std::string body = R"({"do":")" + word + R"(","client":")" + name + R"(","number":)" +
                             std::to_string(++number) + more + '}';
    return client_.post(body).status;
  };
  EXPECT_EQ(give("take", ""), 200);
  EXPECT_EQ(give("sticks", R"(,"velocity":[1,0,0,0])"), 409) << "nobody holds them";
  EXPECT_EQ(give("grip", ""), 200);
  for (int i = 0; i < 60; ++i) client_.post(R"({"do":"join"})");
  EXPECT_EQ(give("alive", ""), 429);
  int refused = 0;
  for (int i = 0; i < 60; ++i) {
    refused += give("sticks", R"(,"velocity":[1,0,0,0])") == 429 ? 1 : 0;
  }
  EXPECT_EQ(refused, 11) << "the clock stands still: a burst of 50, of which one was spent above";
}

TEST_F(Station, APictureComesWithItsOwnNumbers) {
  int seen = 0;
  const auto look = [&](const StreamFrame& frame) {
    const Json words = Json::parse(frame.json);
    if (!words.contains("view")) return true;
    const cv::Mat picture =
        decode_image(std::vector<unsigned char>(frame.jpeg.begin(), frame.jpeg.end()));
    EXPECT_EQ(picture.cols, 64);
    EXPECT_EQ(words["view"]["size_px"][0], 64);
    EXPECT_EQ(words["desk"]["mode"], "hover");
    ++seen;
    return seen < 3;
  };
  std::int64_t number = 0;
  client_.watch(look, [&] { station_->show(view(++number)); });
  EXPECT_EQ(seen, 3);
}

TEST_F(Station, ANewViewerIsNotShownWhatTheOneBeforeItLeft) {
  std::int64_t number = 0;
  client_.watch([](const StreamFrame& frame) { return frame.jpeg.empty(); },
                [&] { station_->show(view(++number)); });
  const std::int64_t left_at = number;
  std::int64_t first = 0;
  StationClient(*station_, token_)
      .watch(
          [&](const StreamFrame& frame) {
            const Json words = Json::parse(frame.json);
            if (!words.contains("view")) return true;
            first = words["view"]["frame"];
            return false;
          },
          [&] { station_->show(view(++number)); });
  EXPECT_GT(first, left_at);
}

TEST_F(Station, MoreStreamsThanThereAreSeatsAreRefused) {
  GroundOptions options;
  options.max_streams = 1;
  const auto small = station(options);
  StationClient first(*small, token_);
  StationClient second(*small, token_);
  bool asked = false;
  std::int64_t number = 0;
  first.watch(
      [&](const StreamFrame&) {
        asked = true;
        EXPECT_EQ(second.stream_status(), 503);
        return false;
      },
      [&] { small->show(view(++number)); });
  EXPECT_TRUE(asked);
  EXPECT_EQ(small->refusals().too_many, 1);
}

TEST_F(Station, ATakenPortIsAnErrorThatNamesIt) {
  GroundOptions options;
  options.port = station_->port();
  try {
    station(options);
    FAIL() << "two programs share a port";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("taken"), std::string::npos) << error.what();
  }
}

TEST(GroundOptions, NameWhatIsOutOfRange) {
  GroundOptions options;
  options.check();
  options.max_streams = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.jpeg_quality = 101;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.port = options.command_port = 8080;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.port = options.stop_port = 8080;
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
