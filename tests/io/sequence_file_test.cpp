#include "kestrel/io/sequence_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/geometry/homography.hpp"
#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/truth_file.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kSequences = std::filesystem::path(KESTREL_SOURCE_DIR) / "sequences";

class SequenceFile : public ::testing::Test {
 protected:
  SequenceDescription load(const std::string& text) {
    return load_sequence(folder_.write("s.yaml", kNeeded + text));
  }
  std::string error_of(const std::string& text) {
    return test::message_of([&] { load(text); });
  }
  const std::string kNeeded =
      "images: frames/%04d.png\nwhat: w\norigin: o\nlicence: l\n";  // four lines
  const std::string kBox = "template_px: [1, 2, 30, 40]\n";
  test::TempFolder folder_;
};

TEST_F(SequenceFile, ReadsWhatIsNeededAndLeavesTheRestOpen) {
  const SequenceDescription d = load(kBox);
  EXPECT_EQ(d.sequence.input, (folder_.path() / "frames/%04d.png").string());
  EXPECT_EQ(d.template_px.u, 1);
  EXPECT_EQ(d.template_px.v, 2);
  EXPECT_EQ(d.template_px.width, 30);
  EXPECT_EQ(d.template_px.height, 40);
  EXPECT_EQ(d.sequence.first_frame, 0);
  EXPECT_FALSE(d.sequence.last_frame || d.sequence.rate_hz || d.sequence.first_number);
  EXPECT_FALSE(d.camera || d.truth || d.target_m);
}

TEST_F(SequenceFile, ReadsEveryKey) {
  const SequenceDescription d =
      load(kBox +
           "package: p\nfirst_number: 12\nfirst_frame: 3\nlast_frame: 9\nrate_hz: 12.5\n"
           "camera: ../c.xml\ncamera_name: nose\ntruth: t.csv\ntarget_m: [0.3, 0.2]\n");
  EXPECT_EQ(d.sequence.package, "p");
  EXPECT_EQ(d.sequence.first_number, 12);
  EXPECT_EQ(d.sequence.first_frame, 3);
  EXPECT_EQ(d.sequence.last_frame, 9);
  EXPECT_EQ(d.sequence.rate_hz, 12.5);
  EXPECT_EQ(d.camera, folder_.path().parent_path() / "c.xml");
  EXPECT_EQ(d.camera_name, "nose");
  EXPECT_EQ(d.truth, folder_.path() / "t.csv");
  EXPECT_EQ((*d.target_m)[0], 0.3);
  EXPECT_EQ((*d.target_m)[1], 0.2);
}

TEST_F(SequenceFile, NamesTheLineOfAMistake) {
  EXPECT_THAT(error_of(""), HasSubstr("s.yaml:1: template_px: is missing"));
  EXPECT_THAT(error_of("template_px: [0, 0, 0, 5]\n"), HasSubstr("s.yaml:5: template_px: is no"));
  EXPECT_THAT(error_of("template_px: [-1, 0, 5, 5]\n"), HasSubstr("is no rectangle"));
  EXPECT_THAT(error_of("template_px: [0.5, 0, 5, 5]\n"), HasSubstr("whole pixels"));
  EXPECT_THAT(error_of(kBox + "first_frame: -1\n"),
              HasSubstr("s.yaml:6: first_frame: is negative"));
  EXPECT_THAT(error_of(kBox + "first_frame: 5\nlast_frame: 4\n"),
              HasSubstr("s.yaml:7: last_frame"));
  EXPECT_THAT(error_of(kBox + "rate_hz: 0\n"), HasSubstr("rate_hz: must be positive"));
  EXPECT_THAT(error_of(kBox + "target_m: [1, 0]\n"), HasSubstr("target_m: must be positive"));
  EXPECT_THAT(error_of(kBox + "template: 1\n"), HasSubstr("did you mean template_px?"));
}

/// The descriptions that are shipped, against their own files.
class ShippedSequence : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedSequence, AgreesWithItsTruthAndCamera) {
  const SequenceDescription d = load_sequence(kSequences / GetParam());
  ASSERT_TRUE(d.truth && d.camera);
  const Truth truth = load_truth(*d.truth);
  EXPECT_EQ(truth.begin()->first, d.sequence.first_frame);
  EXPECT_EQ(truth.rbegin()->first, d.sequence.last_frame);
  const auto corners = template_corners(d.template_px.width, d.template_px.height);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(truth.begin()->second[i].u, d.template_px.u + corners[i].u);
    EXPECT_EQ(truth.begin()->second[i].v, d.template_px.v + corners[i].v);
  }
  const Camera camera = load_camera(*d.camera, d.camera_name);
  EXPECT_NO_THROW(require_resolution(camera, 384, 288, *d.camera));
}

TEST_P(ShippedSequence, FitsTheImagesOfItsPackage) {
  const SequenceDescription d = load_sequence(kSequences / GetParam());
  if (!std::filesystem::exists(std::filesystem::path(d.sequence.input).parent_path())) {
    GTEST_SKIP() << d.sequence.package << " is not installed";
  }
  const auto source = open_sequence(d.sequence);
  EXPECT_EQ(source->frame_count(), *d.sequence.last_frame - d.sequence.first_frame + 1);
  const auto first = source->next();
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->index, d.sequence.first_frame);
  EXPECT_EQ(first->gray.size(), cv::Size(384, 288));
}

INSTANTIATE_TEST_SUITE_P(All, ShippedSequence, ::testing::Values("comic.yaml", "mire2.yaml"));

}  // namespace
}  // namespace kestrel
