#include "kestrel/calibration/camera_model.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(CameraModel, HasANameThatIsFound) {
  for (const CameraModel model : camera_models()) EXPECT_EQ(camera_model_named(name(model)), model);
  EXPECT_EQ(camera_model_named("fisheye"), CameraModel::KannalaBrandt);
  EXPECT_FALSE(camera_model_named("magic").has_value());
}

TEST(CameraModel, ValuesAndCameraAreInverse) {
  for (const CameraModel model : camera_models()) {
    std::vector<double> values;
    for (std::size_t i = 0; i < parameters_of(model).size(); ++i) values.push_back(100 + double(i));
    const CameraParameters camera = camera_with(model, values, 640, 480);
    EXPECT_EQ(values_of(model, camera), values);
    EXPECT_EQ(camera.width, 640);
    EXPECT_EQ(camera.height, 480);
  }
}

TEST(CameraModel, PutsCoefficientsWhereTheLensHasThem) {
  const CameraParameters four =
      camera_with(CameraModel::RadialTangential, {600, 601, 320, 240, 1, 2, 3, 4}, 640, 480);
  EXPECT_EQ(four.lens, Lens::PlumbBob);
  EXPECT_EQ(four.distortion, (std::array<double, 5>{1, 2, 3, 4, 0}));
  const CameraParameters fisheye =
      camera_with(CameraModel::KannalaBrandt, {600, 601, 320, 240, 1, 2, 3, 4}, 640, 480);
  EXPECT_EQ(fisheye.lens, Lens::KannalaBrandt);
  EXPECT_EQ(camera_with(CameraModel::None, {600, 601, 320, 240}, 640, 480).lens, Lens::Pinhole);
}

TEST(CameraModel, NamesUnits) {
  EXPECT_EQ(parameters_of(CameraModel::None)[1].name, "fy");
  EXPECT_EQ(parameters_of(CameraModel::None)[1].unit, "px");
  EXPECT_EQ(parameters_of(CameraModel::Radial)[4].name, "k1");
  EXPECT_EQ(parameters_of(CameraModel::Radial)[4].unit, "");
}

}  // namespace
}  // namespace kestrel
