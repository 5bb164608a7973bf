#include "kestrel/io/camera_writer.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpXmlParserCamera.h>

#include <opencv2/core.hpp>

#include "kestrel/geometry/nearest_visp_camera.hpp"
#include "kestrel/io/camera_file.hpp"

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::HasSubstr;

CameraParameters with(Lens lens, const std::array<double, 5>& distortion) {
  return {610.0 / 3, 605.0 / 3, 320.0 / 7 + 280, 241.25, 640, 480, lens, distortion};
}

std::vector<Camera> cameras() {
  return {Camera(with(Lens::Pinhole, {})), Camera(with(Lens::VispRadial, {-0.02, 0.021})),
          Camera(with(Lens::PlumbBob, {-0.031, 0.0012, 1.5e-4, -2e-4, 1e-5})),
          Camera(with(Lens::PlumbBob, {-0.031, 0.0012, 1.5e-4, -2e-4, 0})),
          Camera(with(Lens::KannalaBrandt, {-0.03, 0.01, -0.004, 0.0007, 0}))};
}

class CameraWriter : public ::testing::Test {
 protected:
  test::TempFolder folder_;
};

TEST_F(CameraWriter, WritesThreeFilesOfTheSameProjections) {
  test::Random random("three files");
  for (const Camera& camera : cameras()) {
    write_camera_files(folder_.path(), camera, "Camera");
    for (const char* name : {"camera.xml", "camera_opencv.yaml", "camera_ros.yaml"}) {
      const Camera read = load_camera(folder_ / name);
      EXPECT_EQ(read.parameters().width, 640);
      EXPECT_EQ(read.parameters().height, 480);
      for (int i = 0; i < 100; ++i) {
        const ImagePoint point{random.uniform(-1.5, 1.5), random.uniform(-1.1, 1.1)};
        const Pixel expected = camera.to_pixel(point);
        EXPECT_NEAR(read.to_pixel(point).u, expected.u, 1e-9) << name;
        EXPECT_NEAR(read.to_pixel(point).v, expected.v, 1e-9) << name;
      }
    }
  }
}

TEST_F(CameraWriter, KeepsEveryBitOfTheParameters) {
  for (const Camera& camera : cameras()) {
    const auto file = folder_.write("c.xml", visp_xml(camera, "nose \"<1>\""));
    const CameraParameters read = load_camera(file, "nose \"<1>\"").parameters();
    EXPECT_EQ(read.lens, camera.parameters().lens);
    EXPECT_EQ(read.px, camera.parameters().px);
    EXPECT_EQ(read.u0, camera.parameters().u0);
    EXPECT_EQ(read.distortion, camera.parameters().distortion);
  }
}

TEST_F(CameraWriter, ViSPReadsItsOwn) {
  for (const Camera& camera : cameras()) {
    const auto file = folder_.write("c.xml", visp_xml(camera, "Camera"));
    const NearestVispCamera nearest = nearest_visp_camera(camera);
    const bool fisheye = camera.parameters().lens == Lens::KannalaBrandt;
    const bool straight = camera.parameters().lens == Lens::Pinhole;
    const auto model = fisheye    ? vpCameraParameters::ProjWithKannalaBrandtDistortion
                       : straight ? vpCameraParameters::perspectiveProjWithoutDistortion
                                  : vpCameraParameters::perspectiveProjWithDistortion;
    vpCameraParameters visp;
    testing::internal::CaptureStdout();  // ViSP's reader prints
    const int answer = vpXmlParserCamera().parse(visp, file.string(), "Camera", model, 640, 480);
    testing::internal::GetCapturedStdout();
    ASSERT_EQ(answer, vpXmlParserCamera::SEQUENCE_OK);
    const Camera ours(nearest.parameters);
    for (const ImagePoint point : {ImagePoint{0.3, -0.4}, ImagePoint{-0.8, 0.6}}) {
      vpImagePoint expected;
      vpMeterPixelConversion::convertPoint(visp, point.x, point.y, expected);
      EXPECT_NEAR(ours.to_pixel(point).u, expected.get_u(), 1e-9);
      EXPECT_NEAR(ours.to_pixel(point).v, expected.get_v(), 1e-9);
    }
  }
}

TEST_F(CameraWriter, OpenCvReadsItsOwn) {
  for (const Camera& camera : cameras()) {
    const auto file = folder_.write("c.yaml", opencv_yaml(camera));
    const cv::FileStorage storage(file.string(), cv::FileStorage::READ);
    cv::Mat matrix;
    cv::Mat lens;
    storage["camera_matrix"] >> matrix;
    storage["distortion_coefficients"] >> lens;
    ASSERT_EQ(matrix.type(), CV_64F);
    EXPECT_EQ(matrix.at<double>(0, 0), camera.parameters().px);
    EXPECT_EQ(matrix.at<double>(1, 2), camera.parameters().v0);
    EXPECT_EQ(lens.rows, camera.parameters().lens == Lens::KannalaBrandt ? 4 : 5);
    EXPECT_EQ(lens.at<double>(0), camera.parameters().distortion[0]);
    EXPECT_EQ(int(storage["image_width"]), 640);
  }
}

TEST_F(CameraWriter, NamesTheLensAsRosDoes) {
  EXPECT_THAT(ros_yaml(cameras()[2], "nose"), HasSubstr("distortion_model: plumb_bob"));
  EXPECT_THAT(ros_yaml(cameras()[4], "nose"), HasSubstr("distortion_model: equidistant"));
  EXPECT_THAT(ros_yaml(cameras()[4], "a \"b\""), HasSubstr("camera_name: \"a \\\"b\\\"\"\n"));
}

TEST_F(CameraWriter, SaysHowFarViSPsLensIs) {
  EXPECT_THAT(visp_xml(cameras()[2], "Camera"), HasSubstr("px off"));
  EXPECT_EQ(visp_xml(cameras()[4], "Camera").find("px off"), std::string::npos);
}

TEST_F(CameraWriter, RefusesAFolderThatIsNotThere) {
  EXPECT_THROW(write_camera_files(folder_ / "none", cameras()[0], "Camera"), std::runtime_error);
}

}  // namespace
}  // namespace kestrel
