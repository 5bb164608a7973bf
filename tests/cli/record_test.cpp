// `kestrel cameras` and `kestrel record` as a user meets them.
#include <csignal>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "cli/rendered_sequence.hpp"
#include "cli/video_sender.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;

int pictures_in(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    count += entry.path().extension() == ".png" ? 1 : 0;
  return count;
}

TEST(Cameras, SaysPlainlyThatThereIsNone) {
  if (fs::exists("/dev/video0")) GTEST_SKIP() << "a camera is here";
  const TempFolder folder;
  const Outcome text = kestrel({"cameras"}, folder.path());
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_SAYS(text.out, "no camera is connected");
  const Outcome json = kestrel({"cameras", "--json"}, folder.path());
  EXPECT_EQ(nlohmann::json::parse(json.out), nlohmann::json::array());
}

TEST(Cameras, ListsAFireWireCamera) {
  const TempFolder folder;
  const std::string standin = std::string("LD_PRELOAD=") + KESTREL_DC1394_STANDIN;
  const Outcome text = Program({"cameras"}, folder.path(), {standin}).wait();
  EXPECT_SAYS(text.out, "dc1394:0123456789abcdef  Stand-in IIDC (FireWire)");
  EXPECT_SAYS(text.out, "  mono8 640x480 at 30, 15 Hz");
  const Outcome json = Program({"cameras", "--json"}, folder.path(), {standin}).wait();
  const auto list = nlohmann::json::parse(json.out);
  EXPECT_EQ(list.at(0).at("source"), "dc1394:0123456789abcdef");
  EXPECT_EQ(list.at(0).at("modes").at(1).at("width_px"), 640);
}

TEST(Record, KeepsAFireWireCameraThatTrackReads) {
  const TempFolder folder;
  const std::string standin = std::string("LD_PRELOAD=") + KESTREL_DC1394_STANDIN;
  const Outcome outcome =
      Program({"record", "dc1394", "--frames", "12", "--rate", "15", "--output", "out"},
              folder.path(), {standin})
          .wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(pictures_in(folder / "out"), 12);
  EXPECT_SAYS(outcome.out, "its driver");
  EXPECT_SAYS(read(folder / "out/stamps.csv"), "frame,stamp_s\n0,");
}

TEST(Record, LosesNothingSilently) {
  const TempFolder folder;
  rendered_sequence(folder / "in", 10);
  const Outcome whole =
      kestrel({"record", "images:in/%04d.png", "--output", "whole"}, folder.path());
  EXPECT_EQ(whole.exit_code, 0) << whole.out << whole.err;
  EXPECT_EQ(pictures_in(folder / "whole"), 10);
  fs::remove(folder / "in/0004.png");
  const Outcome missing =
      kestrel({"record", "images:in/%04d.png", "--output", "missing"}, folder.path());
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_SAYS(missing.err, "1 pictures are missing");
  EXPECT_EQ(pictures_in(folder / "missing"), 9);  // kept all the same
  const Outcome allowed = kestrel(
      {"record", "images:in/%04d.png", "--output", "allowed", "--allow-drops"}, folder.path());
  EXPECT_EQ(allowed.exit_code, 0);
  const Outcome again =
      kestrel({"record", "images:in/%04d.png", "--output", "whole"}, folder.path());
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_SAYS(again.err, "is there already");
}

TEST(Record, TheRecordingIsTrackedAsTheSequenceIs) {
  const TempFolder folder;
  const auto sequence = rendered_sequence(folder / "in", 12);
  kestrel({"record", "images:in/%04d.png", "--roi", sequence.roi, "--output", "out"},
          folder.path());
  const Outcome outcome = kestrel(
      {"track", "sequence:out/sequence.yaml", "--no-video", "--output", "run"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Outcome direct = kestrel(
      {"track", "images:in/%04d.png", "--roi", sequence.roi, "--no-video", "--output", "direct"},
      folder.path());
  EXPECT_EQ(direct.exit_code, 0) << direct.err;
  EXPECT_EQ(read(folder / "run/run.csv"), read(folder / "direct/run.csv"));
}

TEST(Record, KeepsWhatIsThereOnCtrlC) {
  const TempFolder folder;
  const int port = free_port();
  const VideoSender sender({test_picture(320, 240), mpeg_over_udp(port)}, folder.path());
  const std::string source = "udp://127.0.0.1:" + std::to_string(port);
  for (const char* output : {"out", "out.mp4"}) {
    Program record({"record", source, "--allow-drops", "--output", output}, folder.path());
    const bool is_folder = fs::path(output).extension().empty();
    const auto grown = [&] {
      std::error_code none;
      return is_folder
                 ? fs::exists(folder / "out/000010.png")
                 : fs::exists(folder / "out.csv") && fs::file_size(folder / "out.csv", none) > 150;
    };
    for (int k = 0; k < 3000 && !grown(); ++k) usleep(20000);
    record.signal(SIGINT);
    const Outcome outcome = record.wait(60);
    EXPECT_EQ(outcome.exit_code, 130) << outcome.out << outcome.err;
    EXPECT_SAYS(outcome.out, "Ctrl-C");
    const std::string input = is_folder ? "out/sequence.yaml" : "out.mp4";
    const Outcome track = kestrel({"track", input, "--roi", "80,60,160,120", "--no-video",
                                   "--output", std::string("run-") + output},
                                  folder.path());
    EXPECT_EQ(track.exit_code, 0) << track.err;
  }
}

TEST(Record, SaysThatTheDiskIsFull) {
  const TempFolder folder;
  if (Program(Command{{"unshare", "-rm", "true"}}, folder.path()).wait().exit_code != 0)
    GTEST_SKIP() << "no name space for a small disk";
  rendered_sequence(folder / "in", 40);
  fs::create_directory(folder / "small");
  const std::string script = std::string("mount -t tmpfs -o size=200k none small && ") +
                             KESTREL_PROGRAM +
                             " record images:in/%04d.png --output small/out; echo code $?; "
                             "tail -n +2 small/out/stamps.csv | wc -l; ls small/out/*.png | wc -l";
  const Outcome outcome =
      Program(Command{{"unshare", "-rm", "sh", "-c", script}}, folder.path()).wait();
  EXPECT_SAYS(outcome.out, "code 1\n");
  EXPECT_SAYS(outcome.err, "No space left on device; free some space");
  // What was written before is there, and no half picture.
  const auto tail = outcome.out.substr(outcome.out.find("code 1\n") + 7);
  const auto newline = tail.find('\n');
  EXPECT_EQ(tail.substr(0, newline), tail.substr(newline + 1, newline)) << outcome.out;
  EXPECT_GT(std::stoi(tail), 0);
}

}  // namespace
}  // namespace kestrel::test
