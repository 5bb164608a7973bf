#include "kestrel/io/sequence_txt.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kTruth = "frame,x0,y0,x1,y1,x2,y2,x3,y3\n100,10.5,20.2,59.5,21,60.9,80,12,79.5\n";

class SequenceTxt : public ::testing::Test {
 protected:
  SequenceDescription load(const std::string& text) {
    return load_sequence_txt(folder_.write("s/sequence.txt", text));
  }
  std::string error_of(const std::string& text) {
    return test::message_of([&] { load(text); });
  }
  std::string in_folder(const std::string& name) { return (folder_ / "s" / name).string(); }
  test::TempFolder folder_;
};

TEST_F(SequenceTxt, ReadsAVideoAndTheRangeOfItsFrames) {
  folder_.write("s/gt.csv", kTruth);
  const auto d = load(
      "name: cube\nimages: video.mp4\nfirst_frame: 100\nlast_frame: 345\n"
      "template_rect: 222 152 362 277\nobject: a cube: turning\nlicence: GPL-2\n");
  EXPECT_EQ(d.sequence.input, in_folder("video.mp4"));
  EXPECT_EQ(d.sequence.first_frame, 100);
  EXPECT_EQ(d.sequence.last_frame, 345);
  // Both named pixels belong to the rectangle.
  EXPECT_EQ(d.template_px.u, 222);
  EXPECT_EQ(d.template_px.v, 152);
  EXPECT_EQ(d.template_px.width, 141);
  EXPECT_EQ(d.template_px.height, 126);
  EXPECT_EQ(d.what, "a cube: turning");
  EXPECT_EQ(d.truth, std::filesystem::path(in_folder("gt.csv")));
}

TEST_F(SequenceTxt, ReadsAPatternOfAPackage) {
  const auto d = load(
      "images: /usr/share/a/image.%04d.pgm (Debian visp-images-data)\nfirst_number: 12\n"
      "template_rect: 1 2 30 40\n");
  EXPECT_EQ(d.sequence.input, "/usr/share/a/image.%04d.pgm");
  EXPECT_EQ(d.sequence.package, "visp-images-data");
  EXPECT_EQ(d.sequence.first_number, 12);
  EXPECT_FALSE(d.sequence.last_frame);
  EXPECT_FALSE(d.truth);
  EXPECT_EQ(
      load("images: frames/%04d.png (the originals)\ntemplate_rect: 1 2 3 4\n").sequence.input,
      in_folder("frames/%04d.png"));
}

TEST_F(SequenceTxt, ReadsAListAndTakesTheRectangleInsideTheFirstLabels) {
  folder_.write("s/gt.csv", kTruth);
  const auto d =
      load("images: /data/: b.jpg a.jpg in this order (Debian opencv-doc)\ntemplate_rect: \n");
  EXPECT_THAT(d.sequence.files, ElementsAre("/data/b.jpg", "/data/a.jpg"));
  EXPECT_EQ(d.sequence.package, "opencv-doc");
  // The labels span 10.5 .. 60.9 and 20.2 .. 80: whole pixels 11 .. 60 and 21 .. 80.
  EXPECT_EQ(d.template_px.u, 11);
  EXPECT_EQ(d.template_px.v, 21);
  EXPECT_EQ(d.template_px.width, 50);
  EXPECT_EQ(d.template_px.height, 60);
}

TEST_F(SequenceTxt, NamesFileLineAndKeyOfAMistake) {
  EXPECT_THAT(error_of("template_rect: 1 2 3 4\n"), HasSubstr("images: is missing"));
  EXPECT_THAT(error_of("images: a.mp4\n"), HasSubstr("template_rect: is missing"));
  EXPECT_THAT(error_of("images: a.mp4\ntemplate_rect: 1 2 3\n"),
              HasSubstr("sequence.txt:2: template_rect: is '1 2 3'"));
  EXPECT_THAT(error_of("images: a.mp4\ntemplate_rect: 9 2 3 4\n"), HasSubstr("in this order"));
  EXPECT_THAT(error_of("images: a.mp4\n\nimages: b.mp4\n"), HasSubstr("sequence.txt:3: images"));
  EXPECT_THAT(error_of("images: a.mp4\nfirst_frame: -1\n"), HasSubstr(":2: first_frame"));
  EXPECT_THAT(error_of("images: a.mp4\nfirst_frame: 5\nlast_frame: 4\n"),
              HasSubstr("last_frame: comes before"));
  EXPECT_THAT(error_of("images a.mp4\n"), HasSubstr("sequence.txt:1: "));
}

}  // namespace
}  // namespace kestrel
