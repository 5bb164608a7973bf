#include "kestrel/io/camera_file.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpXmlParserCamera.h>

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string xml_camera(const std::string& name, int width, int height, const std::string& models) {
  return "<camera><name>" + name + "</name><image_width>" + std::to_string(width) +
         "</image_width><image_height>" + std::to_string(height) + "</image_height>" + models +
         "</camera>\n";
}

std::string xml_file(const std::string& cameras) {
  return "<?xml version=\"1.0\"?>\n<root>\n" + cameras + "</root>\n";
}

const char* const kPinhole =
    "<model><type>perspectiveProjWithoutDistortion</type><px>600</px><py>610</py><u0>320</u0>"
    "<v0>240</v0></model>";
const char* const kRadial =
    "<model><type>perspectiveProjWithDistortion</type><px>590</px><py>595</py><u0>321</u0>"
    "<v0>241</v0><kud>-0.2</kud><kdu>0.21</kdu></model>";

const char* const kOpenCv =
    "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n"
    "   rows: 3\n   cols: 3\n   dt: d\n   data: [ 600., 0., 320., 0., 610., 240., 0., 0., 1. ]\n"
    "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
    "   data: [ -0.25, 0.08, 1.0e-03, -5.0e-04, -0.01 ]\navg_reprojection_error: 0.3\n";

const char* const kRos =
    "image_width: 640\nimage_height: 480\ncamera_name: nose\n"
    "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [600, 0, 320, 0, 610, 240, 0, 0, 1]\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.25, 0.08, 0.001, -0.0005, -0.01]\n"
    "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";

const char* const kOpenCvXml =
    "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>640</image_width>\n"
    "<image_height>480</image_height>\n<camera_matrix type_id=\"opencv-matrix\">\n"
    "<rows>3</rows><cols>3</cols><dt>d</dt>\n<data>600. 0. 320. 0. 610. 240. 0. 0. 1.</data>"
    "</camera_matrix>\n<distortion_coefficients type_id=\"opencv-matrix\"><rows>5</rows>"
    "<cols>1</cols><dt>d</dt>\n<data>-0.25 8.0e-02 1.0e-03 -5.0e-04\n -0.01</data>"
    "</distortion_coefficients></opencv_storage>\n";

void expect_same_projections(const Camera& a, const Camera& b) {
  test::Random random("projections");
  for (int i = 0; i < 50; ++i) {
    const ImagePoint point{random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4)};
    const Pixel p = a.to_pixel(point);
    const Pixel q = b.to_pixel(point);
    EXPECT_NEAR(p.u, q.u, 1e-9);
    EXPECT_NEAR(p.v, q.v, 1e-9);
  }
}

class CameraFile : public ::testing::Test {
 protected:
  Camera load(const std::string& name, const std::string& text) {
    return load_camera(folder_.write(name, text));
  }
  std::string error_of(const std::string& name, const std::string& text) {
    return message_of([&] { load(name, text); });
  }
  test::TempFolder folder_;
};

TEST_F(CameraFile, GivesOneCameraWhateverItsFormat) {
  const Camera opencv = load("c.yml", kOpenCv);
  EXPECT_EQ(opencv.parameters().lens, Lens::PlumbBob);
  EXPECT_EQ(opencv.parameters().width, 640);
  EXPECT_EQ(opencv.parameters().height, 480);
  EXPECT_EQ(opencv.parameters().py, 610);
  expect_same_projections(opencv, load("c.yaml", kRos));
  expect_same_projections(opencv, load("c.xml", kOpenCvXml));
}

TEST_F(CameraFile, GivesOnePinholeFromXmlAndYaml) {
  std::string yaml = kRos;
  yaml.replace(yaml.find("[-0.25"), std::string("[-0.25, 0.08, 0.001, -0.0005, -0.01]").size(),
               "[0, 0, 0, 0, 0]");
  const Camera a = load("c.yaml", yaml);
  EXPECT_EQ(a.parameters().lens, Lens::Pinhole);
  expect_same_projections(a, load("c.xml", xml_file(xml_camera("Camera", 640, 480, kPinhole))));
}

/// What ViSP itself writes and projects.
class AgainstViSP : public CameraFile {
 protected:
  void expect_agreement(const vpCameraParameters& visp, Lens lens) {
    const auto file = folder_.path() / "visp.xml";
    vpXmlParserCamera().save(visp, file.string(), "Camera", 640, 480);
    const Camera ours = load_camera(file, "Camera", ImageSize{640, 480});
    EXPECT_EQ(ours.parameters().lens, lens);
    EXPECT_EQ(ours.parameters().width, 640);
    test::Random random("visp");
    for (int i = 0; i < 50; ++i) {
      const ImagePoint p{random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4)};
      vpImagePoint expected;
      vpMeterPixelConversion::convertPoint(visp, p.x, p.y, expected);
      // ViSP writes its files with about six significant digits: 640 px times 1e-6.
      EXPECT_NEAR(ours.to_pixel(p).u, expected.get_u(), 1e-3);
      EXPECT_NEAR(ours.to_pixel(p).v, expected.get_v(), 1e-3);
    }
  }
};

TEST_F(AgainstViSP, ProjectsLikeItWithoutDistortion) {
  expect_agreement(vpCameraParameters(592.5, 570.25, 192.125, 144.75), Lens::Pinhole);
}

TEST_F(AgainstViSP, ProjectsLikeItWithRadialDistortion) {
  expect_agreement(vpCameraParameters(592.5, 570.25, 192.125, 144.75, -0.19, 0.2),
                   Lens::VispRadial);
}

TEST_F(AgainstViSP, ProjectsLikeItWithKannalaBrandt) {
  vpCameraParameters visp;
  visp.initProjWithKannalaBrandtDistortion(300.5, 301.25, 320, 240,
                                           {-0.02, 0.003, -0.0007, 0.0001, 0});
  expect_agreement(visp, Lens::KannalaBrandt);
}

TEST_F(CameraFile, PrefersTheModelWithDistortion) {
  const Camera both =
      load("c.xml", xml_file(xml_camera("Camera", 640, 480, std::string(kPinhole) + kRadial)));
  EXPECT_EQ(both.parameters().lens, Lens::VispRadial);
  EXPECT_EQ(both.parameters().px, 590);
  EXPECT_EQ(both.parameters().distortion[0], -0.2);
  EXPECT_EQ(both.parameters().distortion[1], 0.21);
}

TEST_F(CameraFile, ChoosesByNameAndSize) {
  const auto file = folder_.write(
      "c.xml", xml_file(xml_camera("a", 640, 480, kPinhole) + xml_camera("a", 320, 240, kRadial) +
                        xml_camera("b", 640, 480, kRadial)));
  EXPECT_EQ(load_camera(file, "b").parameters().px, 590);
  EXPECT_EQ(load_camera(file, "a", ImageSize{640, 480}).parameters().px, 600);
  EXPECT_EQ(load_camera(file, "a", ImageSize{320, 240}).parameters().px, 590);
  EXPECT_THAT(message_of([&] { load_camera(file, "a"); }),
              AllOf(HasSubstr("c.xml:4: camera: several cameras fit"), HasSubstr("'b' 640x480")));
  EXPECT_THAT(message_of([&] { load_camera(file, "c"); }),
              AllOf(HasSubstr("no camera named 'c'"), HasSubstr("'a' 320x240")));
  EXPECT_THAT(message_of([&] {
                load_camera(file, "b", ImageSize{320, 240});
              }),
              HasSubstr("no camera named 'b' for 320x240 images"));
}

TEST_F(CameraFile, TakesTheOnlyCameraForAnEmptyName) {
  const auto file = folder_.write("c.xml", xml_file(xml_camera("nose", 640, 480, kPinhole)));
  EXPECT_EQ(load_camera(file, "").parameters().px, 600);
  EXPECT_THAT(message_of([&] { load_camera(file); }), HasSubstr("the file has 'nose' 640x480"));
}

TEST_F(CameraFile, PrintsNothing) {
  const auto file = folder_.write("c.xml", xml_file(xml_camera("Camera", 640, 480, kPinhole)));
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  load_camera(file);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(CameraFile, NamesTheLineOfAWrongXmlElement) {
  const auto model = [](const std::string& px) {
    return xml_file(
        "<camera>\n<name>Camera</name>\n<model>\n"
        "<type>perspectiveProjWithoutDistortion</type>\n" +
        px + "<py>1</py><u0>1</u0><v0>1</v0></model></camera>");
  };
  EXPECT_THAT(error_of("c.xml", model("<px>59x</px>\n")),
              HasSubstr("c.xml:7: px: '59x' is not a number"));
  EXPECT_THAT(error_of("c.xml", model("<px>nan</px>\n")), HasSubstr("not finite"));
  EXPECT_THAT(error_of("c.xml", model("<px/>\n")), HasSubstr("c.xml:7: px: has 0 numbers"));
  EXPECT_THAT(error_of("c.xml", model("")), HasSubstr("c.xml:5: model: <px> is missing"));
  EXPECT_THAT(error_of("c.xml", model("<px>1</px><px>2</px>")), HasSubstr("px: is given twice"));
  EXPECT_THAT(error_of("c.xml", model("<px>-5</px>")), HasSubstr("focal length must be positive"));
}

TEST_F(CameraFile, RefusesXmlThatHoldsNoCamera) {
  EXPECT_THAT(error_of("c.xml", ""), HasSubstr("is no XML"));
  EXPECT_THAT(error_of("c.xml", "<root><camera></root>"), HasSubstr("c.xml:1: is no XML"));
  EXPECT_THAT(error_of("c.xml", "<html/>"), HasSubstr("is no camera file"));
  EXPECT_THAT(error_of("c.xml", xml_file("")), HasSubstr("add a <camera>"));
  EXPECT_THAT(error_of("c.xml", xml_file(xml_camera("Camera", 640, 480, ""))),
              HasSubstr("has no <model>"));
  EXPECT_THAT(error_of("c.xml", xml_file(xml_camera("Camera", 0, 480, kPinhole))),
              HasSubstr("image_width: is no size"));
  EXPECT_THAT(error_of("c.xml", xml_file(xml_camera("Camera", 640, 480,
                                                    "<model><type>magic</type></model>"))),
              HasSubstr("'magic' is no known lens model"));
}

TEST_F(CameraFile, RefusesYamlThatHoldsNoCameraOfOurs) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = kRos;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(error_of("c.yaml", changed("plumb_bob", "rational")),
              HasSubstr("c.yaml:8: distortion_model: is 'rational', which is not read"));
  EXPECT_THAT(error_of("c.yaml", changed("plumb_bob", "equidistant")),
              HasSubstr("has 5 coefficients; give the 4 of a fisheye"));
  EXPECT_THAT(error_of("c.yaml", changed("[600, 0, ", "[600, ")), HasSubstr("has 8 numbers"));
  EXPECT_THAT(error_of("c.yaml", changed("[600, 0, 320, 0, 610, 240", "[600, 0, 0, 0, 610, 0")),
              ::testing::Not(HasSubstr("order")));
  EXPECT_THAT(error_of("c.yaml", changed("240, 0, 0, 1]", "240, 5, 0, 1]")), HasSubstr("order"));
  EXPECT_THAT(error_of("c.yaml", changed("[600", "[.nan")), HasSubstr("not finite"));
  EXPECT_THAT(error_of("c.yaml", changed("[600", "[-600")), HasSubstr("must be positive"));
  EXPECT_THAT(error_of("c.yaml", changed("-0.01]", "-0.01, 0.5]")), HasSubstr("6 coefficients"));
  EXPECT_THAT(error_of("c.yaml", "a: 1\n"), HasSubstr("camera_matrix: is missing"));
  EXPECT_THAT(error_of("c.json", "{}"), HasSubstr("give a .xml, .yml or .yaml file"));
  EXPECT_THAT(message_of([&] { load_camera(folder_.path() / "none.xml"); }),
              HasSubstr("there is no such file"));
}

TEST_F(CameraFile, TakesMoreCoefficientsWhenTheyAreZero) {
  std::string text = kRos;
  const std::string end = "-0.01]";
  text.replace(text.find(end), end.size(), "-0.01, 0, 0, 0]");
  expect_same_projections(load("c.yaml", text), load("d.yaml", kRos));
}

TEST(RequireResolution, RefusesImagesOfAnotherSize) {
  CameraParameters p;
  p.px = p.py = 500;
  p.width = 640;
  p.height = 480;
  EXPECT_NO_THROW(require_resolution(Camera(p), 640, 480, "c.xml"));
  EXPECT_EQ(message_of([&] { require_resolution(Camera(p), 320, 240, "c.xml"); }),
            "c.xml: the camera is calibrated for 640x480 images, these are 320x240; calibrate at "
            "this size or choose another camera file");
  EXPECT_THROW(require_resolution(Camera(p), 640, 360, "c.xml"), FileError);
  EXPECT_THROW(require_resolution(Camera(p), 641, 480, "c.xml"), FileError);
  p.width = p.height = 0;
  EXPECT_NO_THROW(require_resolution(Camera(p), 320, 240, "c.xml"));
}

}  // namespace
}  // namespace kestrel
