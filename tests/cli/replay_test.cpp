// Recorded runs, `track --ground` and TLS as their users meet them: the real program and, where
// there is one, a real browser.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <httplib.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/browser.hpp"
#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

const std::string kToken(64, 'a');
const std::string kBearer = "Bearer " + kToken;

bool comes(const std::function<bool()>& happens) {
  for (int i = 0; i < 600; ++i) {  // a minute: waited out only when something is broken
    if (happens()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

class Replay : public testing::Test {
 protected:
  void SetUp() override {
    sequence_ = rendered_sequence(folder_ / "frames", 40);
    folder_.write("token", kToken + "\n");
    fs::permissions(folder_ / "token", fs::perms(0600));
  }

  /// A run of the tracker over the sequence.
  std::string tracked(const std::string& name, const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"track",       "frames/%04d.png", "--roi",
                                 sequence_.roi, "--output",        name};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = kestrel(all, folder_.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return name;
  }
  std::unique_ptr<Program> serve(std::vector<std::string> arguments) {
    for (const std::string& word : {std::string("--ground"), std::to_string(port_),
                                    std::string("--ground-token"), std::string("token")}) {
      arguments.push_back(word);
    }
    return std::make_unique<Program>(arguments, folder_.path());
  }
  std::unique_ptr<Browser> browser(const std::string& scheme = "http") {
    auto made = std::make_unique<Browser>(port_ + 3, folder_.path());
    const std::string page = scheme + "://127.0.0.1:" + std::to_string(port_) + "/#token=" + kToken;
    EXPECT_TRUE(comes([&] {
      try {
        made->go(page);
        return true;
      } catch (const std::runtime_error&) {
        return false;  // nothing listens there yet
      }
    }));
    return made;
  }
  static void press(Browser& in, const std::string& key) {
    in.run("document.dispatchEvent(new KeyboardEvent('keydown', {key: '" + key +
           "', bubbles: true})); return 0");
  }
  static bool is_at(Browser& in, int row) {
    return comes([&] {
      return in.run("return document.documentElement.dataset.row || ''") ==
             '"' + std::to_string(row) + '"';
    });
  }
  /// A copy of a run whose log ends in the middle of a line.
  void cut(const std::string& run, const std::string& copy) {
    fs::copy(folder_ / run, folder_ / copy);
    const std::string log = read(folder_ / run / "run.csv");
    std::ofstream(folder_ / copy / "run.csv") << log.substr(0, log.size() / 2);
  }

  const int port_ = 20000 + int(getpid() % 3000) * 4;
  const TempFolder folder_;
  RenderedSequence sequence_;
};

TEST_F(Replay, ARunIsSteppedPlayedAndComparedInTheBrowser) {
  if (!Browser::is_there()) GTEST_SKIP() << "no chromium or no chromium-driver on this machine";
  tracked("one");
  tracked("two", {"--method", "detect", "--no-video"});
  const auto program = serve({"replay", "one", "two/"});
  const auto page = browser();
  ASSERT_TRUE(is_at(*page, 0)) << page->text("line");
  EXPECT_NE(page->text("mode").find("a recorded run"), std::string::npos);
  EXPECT_NE(page->text("sight").find("Target seen"), std::string::npos);
  press(*page, ".");
  press(*page, ".");
  EXPECT_TRUE(is_at(*page, 2));
  press(*page, ",");
  EXPECT_TRUE(is_at(*page, 1));
  EXPECT_NE(page->text("numbers").find("1, 0.03 s"), std::string::npos) << page->text("numbers");
  press(*page, "End");
  EXPECT_TRUE(is_at(*page, 39));
  press(*page, "ArrowLeft");
  EXPECT_TRUE(is_at(*page, 38)) << "back, where nothing has been fetched yet";
  page->run(
      "const t = document.getElementById('time'); t.value = 0.5;"
      "t.dispatchEvent(new Event('input')); return 0");
  EXPECT_TRUE(is_at(*page, 15));
  page->click("turn");
  EXPECT_TRUE(comes([&] { return page->text("when").find("two: ") == 0; }));
  EXPECT_NE(page->text("replay").find("there are no pictures"), std::string::npos);
  press(*page, "Home");
  EXPECT_TRUE(is_at(*page, 0));
  page->click("play");
  EXPECT_TRUE(is_at(*page, 39)) << "plays to its end";
  EXPECT_EQ(page->run("return document.getElementById('abort').offsetParent === null"), "true")
      << "no command where nothing flies";
}

TEST_F(Replay, FoldersThatAreNoRunsSayWhatIsMissing) {
  const Outcome missing = kestrel({"replay", "nowhere"}, folder_.path());
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_SAYS(missing.err, "nowhere: is no run folder; one has the file run.csv in it");
  tracked("one");
  fs::create_directory(folder_ / "empty");
  std::ofstream(folder_ / "empty" / "run.csv")
      << read(folder_ / "one" / "run.csv").substr(0, read(folder_ / "one" / "run.csv").find('\n'))
      << '\n';
  const Outcome empty = kestrel({"replay", "empty"}, folder_.path());
  EXPECT_EQ(empty.exit_code, 1);
  EXPECT_SAYS(empty.err, "holds no frame");
  std::ofstream(folder_ / "empty" / "run.csv") << "what is this\n1\n";
  EXPECT_EQ(kestrel({"replay", "empty"}, folder_.path()).exit_code, 1);
  EXPECT_EQ(kestrel({"replay"}, folder_.path()).exit_code, 2);
  EXPECT_EQ(kestrel({"replay", "one", "one", "one"}, folder_.path()).exit_code, 2);
}

TEST_F(Replay, AHalfWrittenRunIsShownAsFarAsItGoes) {
  tracked("one");
  cut("one", "half");
  std::ofstream(folder_ / "half" / "run.mp4") << "the disk was full";
  const auto program = serve({"replay", "half"});
  httplib::Client client("127.0.0.1", port_);
  httplib::Response runs;
  ASSERT_TRUE(comes([&] {
    const auto given = client.Get("/runs", {{"Authorization", kBearer}});
    if (given) runs = *given;
    return bool(given);
  }));
  const auto run = nlohmann::json::parse(runs.body)[0];
  EXPECT_GT(run["frame"].size(), 5u);
  EXPECT_LT(run["frame"].size(), 40u);
  EXPECT_SAYS(run["notes"].dump(), "has no end and was left out");
  EXPECT_SAYS(run["notes"].dump(), "its video cannot be read");
  EXPECT_EQ(client.Get("/frames?run=0&from=0&count=2", {{"Authorization", kBearer}})->status, 200);
  program->signal(SIGINT);
  EXPECT_EQ(program->wait().exit_code, 130);
}

TEST_F(Replay, TrackIsLookedAtAndTakesNoCommand) {
  const auto program = serve({"track", "frames/%04d.png", "--roi", sequence_.roi, "--output",
                              "watched", "--no-video", "--rate", "5"});
  httplib::Client commands("127.0.0.1", port_ + 1);
  httplib::Response answer;
  ASSERT_TRUE(comes([&] {
    const auto given = commands.Post("/command", {{"Authorization", kBearer}}, R"({"do":"abort"})",
                                     "application/json");
    if (given) answer = *given;
    return bool(given);
  }));
  EXPECT_EQ(answer.status, 409);
  EXPECT_SAYS(answer.body, "nothing flies here");
  std::string seen;
  httplib::Client page("127.0.0.1", port_);
  page.Get("/stream", {{"Authorization", kBearer}}, [&](const char* data, std::size_t size) {
    seen.append(data, size);
    return seen.find("\"status\":\"found\"") == std::string::npos;
  });
  EXPECT_SAYS(seen, "\"status\":\"found\"");
}

TEST_F(Replay, ATlsPageIsServedToABrowser) {
  if (!Browser::is_there()) GTEST_SKIP() << "no chromium or no chromium-driver on this machine";
  const auto program = serve({"simulate", KESTREL_SOURCE_DIR "/tasks/hover.yaml", "--no-video",
                              "--output", "run", "--ground-tls", "self-signed"});
  const auto page = browser("https");
  EXPECT_TRUE(comes([&] { return page->text("sight").find("Target seen") == 0; }))
      << page->text("line");
  page->click("take");
  EXPECT_TRUE(comes([&] { return page->text("answer").find("you have the command") == 0; }))
      << page->text("answer");
  program->signal(SIGINT);
  const Outcome outcome = program->wait();
  EXPECT_SAYS(outcome.err, "ground station: https://127.0.0.1:");
  EXPECT_SAYS(outcome.err, "SHA-256 fingerprint");
}

TEST_F(Replay, WhatIsNotSafeIsRefusedBeforeAnythingListens) {
  const std::vector<std::string> fly{"simulate", KESTREL_SOURCE_DIR "/tasks/hover.yaml",
                                     "--no-video", "--ground", "0"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), fly.begin(), fly.end());
    return kestrel(more, folder_.path());
  };
  const Outcome open = with({"--ground-bind", "0.0.0.0"});
  EXPECT_EQ(open.exit_code, 2);
  EXPECT_SAYS(open.err, "--ground-plain");
  EXPECT_EQ(with({"--ground-cert", "cert.pem"}).exit_code, 2) << "half an identity";
  EXPECT_EQ(with({"--ground-tls", "magic"}).exit_code, 2);
  folder_.write("key.pem", "no key");
  folder_.write("cert.pem", "no certificate");
  fs::permissions(folder_ / "key.pem", fs::perms(0644));
  const Outcome readable = with({"--ground-cert", "cert.pem", "--ground-key", "key.pem"});
  EXPECT_EQ(readable.exit_code, 1);
  EXPECT_SAYS(readable.err, "chmod 600 key.pem");
  fs::permissions(folder_ / "key.pem", fs::perms(0600));
  const Outcome wrong = with({"--ground-cert", "cert.pem", "--ground-key", "key.pem"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_SAYS(wrong.err, "no certificate in PEM");
  EXPECT_FALSE(fs::exists(folder_ / "runs")) << "a run that does not begin leaves no folder";
}

}  // namespace
}  // namespace kestrel::test
