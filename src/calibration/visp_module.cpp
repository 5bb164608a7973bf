#include "visp_module.hpp"

#include <visp3/core/vpException.h>
#include <visp3/vision/vpCalibration.h>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace kestrel {
namespace {

std::vector<vpCalibration> tables(const std::vector<std::vector<VispPoint>>& views) {
  std::vector<vpCalibration> all;
  for (const auto& view : views) {
    vpCalibration table;
    table.clearPoint();
    for (const VispPoint& point : view) {
      vpImagePoint seen(point.seen.v, point.seen.u);
      table.addPoint(point.x_m, point.y_m, 0, seen);
    }
    all.push_back(table);
  }
  return all;
}

std::optional<CameraParameters> calibrate(const std::vector<std::vector<VispPoint>>& views,
                                          const CameraParameters& start, Lens lens) {
  const bool bent = lens == Lens::VispRadial;
  try {
    std::vector<vpCalibration> all = tables(views);
    vpCameraParameters camera(start.px, start.py, start.u0, start.v0);
    double error_px = 0;
    // As ViSP's own program: without distortion first, which also gives each view its pose.
    for (vpCalibration& table : all) {
      vpHomogeneousMatrix pose;
      vpCameraParameters alone = camera;
      if (table.computeCalibration(vpCalibration::CALIB_VIRTUAL_VS, pose, alone) != 0)
        return std::nullopt;
    }
    using Method = vpCalibration::vpCalibrationMethodType;
    const Method straight = vpCalibration::CALIB_VIRTUAL_VS;
    if (vpCalibration::computeCalibrationMulti(straight, all, camera, error_px) != 0)
      return std::nullopt;
    const Method radial = vpCalibration::CALIB_VIRTUAL_VS_DIST;
    if (bent && vpCalibration::computeCalibrationMulti(radial, all, camera, error_px) != 0)
      return std::nullopt;
    CameraParameters found{camera.get_px(),
                           camera.get_py(),
                           camera.get_u0(),
                           camera.get_v0(),
                           start.width,
                           start.height,
                           lens};
    if (bent) found.distortion = {camera.get_kud(), camera.get_kdu()};
    return found;
  } catch (const vpException&) {
    return std::nullopt;
  }
}

}  // namespace

extern "C" const VispModule kKestrelModule;
const VispModule kKestrelModule{calibrate};

}  // namespace kestrel
