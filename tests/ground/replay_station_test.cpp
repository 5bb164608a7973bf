#include "kestrel/ground/replay_station.hpp"

#include <gtest/gtest.h>
#include <httplib.h>

#include <nlohmann/json.hpp>

#include "kestrel/ground/stream_frame.hpp"
#include "kestrel/io/image_codec.hpp"
#undef _res  // a macro of resolv.h

#include "ground/small_run.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::json;

class Replayed : public testing::Test {
 protected:
  static std::vector<Recording> recordings() {
    std::vector<Recording> two(2);
    two[0].run = test::small_run("first", 100);
    two[1].run = test::small_run("second", 5);
    return two;
  }
  httplib::Result get(const std::string& path) {
    return client_.Get(path, {{"Authorization", "Bearer " + token_.text()}});
  }
  std::vector<StreamFrame> frames(const std::string& query) {
    StreamReader reader;
    reader.add(get("/frames?" + query)->body);
    std::vector<StreamFrame> all;
    while (auto frame = reader.next()) all.push_back(std::move(*frame));
    return all;
  }

  const AccessToken token_ = random_token();
  const ReplayStation station_{{}, token_, recordings()};
  httplib::Client client_{"127.0.0.1", station_.port()};
};

TEST_F(Replayed, ThePageKnowsThatItShowsRuns) {
  const auto page = client_.Get("/");
  ASSERT_EQ(page->status, 200);
  EXPECT_NE(page->body.find("name=\"recorded-runs\" content=\"2\""), std::string::npos);
  EXPECT_EQ(client_.Get("/ground.js")->status, 200);
}

TEST_F(Replayed, RunsAndFramesNeedTheToken) {
  EXPECT_EQ(client_.Get("/runs")->status, 401);
  EXPECT_EQ(client_.Get("/frames?run=0&from=0&count=1")->status, 401);
  EXPECT_EQ(station_.refusals().wrong_token, 2);
  const Json runs = Json::parse(get("/runs")->body);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[1]["name"], "second");
  EXPECT_EQ(runs[0]["frame"].size(), 100u);
}

TEST_F(Replayed, FramesComeAsAStreamBringsThem) {
  const auto some = frames("run=0&from=7&count=3");
  ASSERT_EQ(some.size(), 3u);
  const Json words = Json::parse(some[2].json);
  EXPECT_EQ(words["row"], 9);
  EXPECT_EQ(words["view"]["frame"], 109);
  EXPECT_EQ(words["desk"]["view_only"], "a recorded run: nothing flies here");
  const cv::Mat picture =
      decode_image(std::vector<unsigned char>(some[2].jpeg.begin(), some[2].jpeg.end()));
  EXPECT_EQ(picture.cols, 640) << "black, of a size that holds the outlines";
}

TEST_F(Replayed, TheEndOfARunEndsTheAnswer) {
  EXPECT_EQ(frames("run=1&from=3&count=30").size(), 2u);
}

TEST_F(Replayed, WhatIsNotThereIsRefused) {
  long refused = 0;
  for (const char* query :
       {"run=2&from=0&count=1", "run=0&from=100&count=1", "run=0&from=0&count=65",
        "run=0&from=0&count=0", "run=0&from=-1&count=1", "run=0&from=1e3&count=1", "from=0&count=1",
        "run=99999999999999999999&from=0&count=1"}) {
    EXPECT_EQ(get(std::string("/frames?") + query)->status, 400) << query;
    EXPECT_EQ(station_.refusals().malformed, ++refused) << query;
  }
}

TEST(ReplayStation, TakesOneRunOrTwo) {
  const AccessToken token = random_token();
  EXPECT_THROW(ReplayStation({}, token, {}), std::invalid_argument);
  EXPECT_THROW(ReplayStation({}, token, std::vector<Recording>(3)), std::invalid_argument);
  EXPECT_THROW(ReplayStation({}, token, std::vector<Recording>(1)), std::invalid_argument)
      << "a run without a frame";
}

}  // namespace
}  // namespace kestrel
