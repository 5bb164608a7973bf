#include "visp_module.hpp"

#include <cstdio>
#include <iostream>

#include <fcntl.h>
#include <unistd.h>
#include <visp3/core/vpException.h>
#include <visp3/vision/vpCalibration.h>
#include <visp3/vision/vpHandEyeCalibration.h>

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

/// Nothing that is written to the standard output appears while this lives: ViSP's hand-eye
/// calibration prints pages there, by std::cout and by printf, between what the program prints.
class Silence {
 public:
  Silence() {
    flush();
    before_ = dup(STDOUT_FILENO);
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (before_ >= 0 && nothing >= 0) dup2(nothing, STDOUT_FILENO);
    if (nothing >= 0) close(nothing);
  }
  ~Silence() {
    flush();
    if (before_ < 0) return;
    dup2(before_, STDOUT_FILENO);
    close(before_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static void flush() {
    std::cout.flush();
    std::fflush(stdout);
  }
  int before_ = -1;
};

template <class To, class From>
vpHomogeneousMatrix to_visp(const Transform<To, From>& pose) {
  vpHomogeneousMatrix M;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) M[i][j] = pose.rotation(i, j);
    M[i][3] = pose.translation[i];
  }
  return M;
}

std::optional<Mount> hand_eye(const std::vector<VispStation>& stations) {
  std::vector<vpHomogeneousMatrix> cMo;
  std::vector<vpHomogeneousMatrix> rMe;
  for (const VispStation& station : stations) {
    cMo.push_back(to_visp(station.camera_from_target));
    rMe.push_back(to_visp(station.world_from_body));
  }
  const Silence silence;
  try {
    vpHomogeneousMatrix eMc;
    if (vpHandEyeCalibration::calibrate(cMo, rMe, eMc) != 0) return std::nullopt;
    Mount mount;
    for (unsigned i = 0; i < 3; ++i) {
      for (unsigned j = 0; j < 3; ++j) mount.rotation(i, j) = eMc[i][j];
      mount.translation[i] = eMc[i][3];
    }
    return mount;
  } catch (const vpException&) {
    return std::nullopt;
  }
}

}  // namespace

extern "C" const VispModule kKestrelModule;
const VispModule kKestrelModule{calibrate, hand_eye};

}  // namespace kestrel
