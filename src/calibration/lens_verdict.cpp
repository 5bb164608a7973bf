#include "lens_verdict.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

using Objections = std::vector<Objection>;

void implausible(const CameraParameters& p, Objections& list) {
  // From a 10-fold tele lens to the widest that is no fisheye.
  constexpr double kNarrowest = 3 * kDegree;
  constexpr double kWidest_pinhole = 140 * kDegree;
  const double wide = 2 * std::atan(p.width / 2.0 / p.px);
  const bool fisheye = p.lens == Lens::KannalaBrandt;
  if (wide < kNarrowest || (!fisheye && wide > kWidest_pinhole)) {
    list.push_back({Gravity::Refusal,
                    fmt::format("a focal length of {:.0f} px, {:.0f} degrees across the image, is "
                                "implausible",
                                p.px, wide / kDegree),
                    "check the board's columns and rows, and add tilted views"});
  }
  // Analogue video has pixels up to 1.1 times as high as wide.
  const double aspect = p.px / p.py;
  if (aspect < 0.8 || aspect > 1.25) {
    list.push_back({Gravity::Refusal,
                    fmt::format("pixels {:.2f} times as high as wide are implausible", aspect),
                    "tilt the board about both axes, and check that it is flat"});
  }
  const double away = std::max(std::abs(p.u0 / p.width - 0.5), std::abs(p.v0 / p.height - 0.5));
  if (away > 0.25) {
    list.push_back(
        {Gravity::Refusal,
         fmt::format("the centre ({:.0f}, {:.0f}) px is far from that of the image", p.u0, p.v0),
         "use whole pictures as the camera gives them, and add tilted views"});
  }
}

/// Whether a fisheye's angle stops growing with the distance from the centre before this one, px.
/// Beyond 90 degrees off axis there is no point of the image plane, but a good fisheye all the
/// same.
bool fisheye_folds(const CameraParameters& p, double radius_px) {
  constexpr double kStep = 0.01;
  const auto& k = p.distortion;
  double distorted = 0;
  for (double angle = kStep; angle < M_PI && distorted * p.px < radius_px; angle += kStep) {
    const double t2 = angle * angle;
    const double next = angle * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
    if (!(next > distorted)) return true;
    distorted = next;
  }
  return false;
}

/// Whether the lens puts two rays on one pixel somewhere before a corner of the image.
bool folds(const CameraParameters& p, const Pixel& corner) {
  if (p.lens == Lens::KannalaBrandt)
    return fisheye_folds(p, std::hypot(corner.u - p.u0, corner.v - p.v0));
  const ImagePoint point = Camera(p).to_image_point(corner);
  return !std::isfinite(point.x) || !std::isfinite(point.y);
}

void folded(const CameraParameters& p, Objections& list) {
  const double right = p.width - 1.0;
  const double bottom = p.height - 1.0;
  for (const Pixel corner :
       {Pixel{0, 0}, Pixel{right, 0}, Pixel{0, bottom}, Pixel{right, bottom}}) {
    if (!folds(p, corner)) continue;
    list.push_back({Gravity::Refusal, "the lens model folds over inside the image",
                    "show the board in the corners of the image, or choose a simpler lens model "
                    "(kannala-brandt for a fisheye)"});
    return;
  }
}

}  // namespace

std::vector<Objection> lens_objections(const CameraParameters& camera) {
  Objections list;
  implausible(camera, list);
  folded(camera, list);
  return list;
}

}  // namespace kestrel
