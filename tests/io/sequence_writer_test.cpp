#include "kestrel/io/sequence_writer.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "kestrel/io/camera_file.hpp"
#include "kestrel/io/sequence_file.hpp"
#include "kestrel/io/truth_file.hpp"

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

CameraParameters parameters(Lens lens) {
  CameraParameters p;
  p.px = 601.25;
  p.py = 599;
  p.u0 = 31.5;
  p.v0 = 23.25;
  p.width = 64;
  p.height = 48;
  p.lens = lens;
  if (lens != Lens::Pinhole) p.distortion = {0.1, -0.02, 0.001, -0.002, 0.003};
  return p;
}

SequenceHead head(Lens lens = Lens::Pinhole) {
  return {12.5, {3, 4, 20, 16}, Camera(parameters(lens)), "a 'box': red", "made up", "none"};
}

RecordedFrame frame(std::int64_t index) {
  test::Random random("recorded frame " + std::to_string(index));
  RecordedFrame f;
  f.index = index;
  f.stamp_s = double(index) / 12.5;
  f.gray.create(48, 64, CV_8U);
  for (int i = 0; i < 48 * 64; ++i) f.gray.data[i] = std::uint8_t(random.integer(0, 255));
  for (Pixel& p : f.corners) p = {random.uniform(0, 64), random.uniform(0, 48)};
  return f;
}

// What is written is read back by the readers of recorded sequences, to the last bit.
TEST(SequenceWriter, IsReadBackAsItWas) {
  const test::TempFolder folder;
  {
    SequenceWriter writer(folder.path() / "deep/er", "hop", head());
    for (const int k : {0, 1, 3}) {  // 2 was dropped
      RecordedFrame f = frame(k);
      f.is_labelled = k != 1;
      writer.write(f);
    }
  }
  const SequenceDescription read = load_sequence(folder.path() / "deep/er/hop.yaml");
  EXPECT_EQ(read.what, "a 'box': red");
  EXPECT_EQ(read.origin, "made up");
  EXPECT_EQ(read.licence, "none");
  EXPECT_EQ(read.template_px.u, 3);
  EXPECT_EQ(read.template_px.height, 16);
  const auto source = open_sequence(read.sequence);
  for (const int k : {0, 1, 3}) {
    const auto got = source->next();
    ASSERT_TRUE(got) << k;
    EXPECT_EQ(got->index, k);
    EXPECT_DOUBLE_EQ(got->stamp_s, k / 12.5);
    EXPECT_EQ(cv::norm(got->gray, frame(k).gray, cv::NORM_INF), 0) << k;
  }
  EXPECT_FALSE(source->next());
  const Truth truth = load_truth(*read.truth);
  ASSERT_EQ(truth.size(), 2u);
  for (const int k : {0, 3}) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(truth.at(k)[i].u, frame(k).corners[i].u);
      EXPECT_EQ(truth.at(k)[i].v, frame(k).corners[i].v);
    }
  }
}

TEST(SequenceWriter, KeepsTheCameraWhateverItsLens) {
  for (const Lens lens : {Lens::Pinhole, Lens::PlumbBob, Lens::KannalaBrandt}) {
    const test::TempFolder folder;
    const SequenceWriter writer(folder.path(), "hop", head(lens));
    const SequenceDescription read = load_sequence(folder.path() / "hop.yaml");
    ASSERT_TRUE(read.camera);
    const Camera camera = load_camera(*read.camera, "");
    const ImagePoint off_axis{0.03, -0.02};
    EXPECT_EQ(camera.to_pixel(off_axis).u, Camera(parameters(lens)).to_pixel(off_axis).u);
    EXPECT_EQ(camera.to_pixel(off_axis).v, Camera(parameters(lens)).to_pixel(off_axis).v);
    EXPECT_EQ(camera.parameters().width, 64);
  }
}

TEST(SequenceWriter, WritesOverNothing) {
  const test::TempFolder folder;
  const SequenceWriter writer(folder.path(), "hop", head());
  EXPECT_THROW(SequenceWriter(folder.path(), "hop", head()), std::runtime_error);
  EXPECT_NO_THROW(SequenceWriter(folder.path(), "jump", head()));
  EXPECT_THROW(SequenceWriter(folder.path() / "hop.yaml", "hop", head()), std::runtime_error);
}

TEST(SequenceWriter, RefusesAPictureThatIsNone) {
  const test::TempFolder folder;
  SequenceWriter writer(folder.path(), "hop", head());
  RecordedFrame f = frame(0);
  f.gray.release();
  EXPECT_THROW(writer.write(f), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
