#include "kestrel/calibration/calibration_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "lens_verdict.hpp"

namespace kestrel {
namespace {

constexpr double kDegree = M_PI / 180;

using Objections = std::vector<Objection>;

void too_few(std::size_t views, const VerdictOptions& o, Objections& list) {
  const std::string what = fmt::format("the board is seen in {} pictures", views);
  if (int(views) < o.fewest_views) {
    list.push_back(
        {Gravity::Refusal, what,
         fmt::format("take {} to 20 that show it at different places and tilts", o.enough_views)});
  } else if (int(views) < o.enough_views) {
    list.push_back(
        {Gravity::Doubt, what, fmt::format("{} to 20 settle a camera better", o.enough_views)});
  }
}

/// The largest angle between two views of the board's normal.
double spread_of_tilts(const Calibration& calibration) {
  double largest = 0;
  for (const SolvedView& a : calibration.views) {
    for (const SolvedView& b : calibration.views) {
      const double cosine =
          a.camera_from_board.rotation.col(2).dot(b.camera_from_board.rotation.col(2));
      largest = std::max(largest, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
  }
  return largest;
}

void no_tilt(const Calibration& calibration, const VerdictOptions& o, Objections& list) {
  const double spread = spread_of_tilts(calibration);
  if (spread >= o.tilt_rad) return;
  list.push_back({Gravity::Refusal,
                  fmt::format("the board's tilt differs by {:.1f} degrees only", spread / kDegree),
                  "tilt it by 20 to 45 degrees to all four sides: without tilt focal length and "
                  "distance cannot be told apart"});
}

void large_residuals(const Calibration& calibration, const VerdictOptions& o, Objections& list) {
  const double scale = std::max(1.0, calibration.camera.width / 640.0);
  if (calibration.rms_px <= o.rms_doubted_px * scale) return;
  const bool refused = calibration.rms_px > o.rms_refused_px * scale;
  list.push_back({refused ? Gravity::Refusal : Gravity::Doubt,
                  fmt::format("the reprojection error is {:.2f} px", calibration.rms_px),
                  "check the board's columns and rows and that it is flat, leave blurred pictures "
                  "out, or choose a lens model that bends as this lens does"});
}

void uncertain(const Calibration& calibration, const VerdictOptions& o, Objections& list) {
  double worst = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const ParameterEstimate& focal = calibration.parameters[i];
    worst = std::max(worst, focal.deviation / focal.value);
  }
  if (!(worst > o.focal_doubt)) return;
  list.push_back({worst > 10 * o.focal_doubt ? Gravity::Refusal : Gravity::Doubt,
                  fmt::format("the focal length is known to {:.1f} % only", 100 * worst),
                  "add views with a strong tilt (20 to 45 degrees), near ones too"});
}

void covered(const Coverage& coverage, const VerdictOptions& o, Objections& list) {
  if (coverage.share >= o.coverage_doubted) return;
  list.push_back({coverage.share < o.coverage_refused ? Gravity::Refusal : Gravity::Doubt,
                  fmt::format("the board was seen in {:.0f} % of the image", 100 * coverage.share),
                  "move it to all borders and corners: where it never was, the lens is a guess"});
}

void standing_out(const Calibration& calibration, const VerdictOptions& o, Objections& list) {
  std::vector<double> errors;
  for (const SolvedView& view : calibration.views) errors.push_back(view.rms_px);
  const auto middle = errors.begin() + std::ptrdiff_t(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  for (const SolvedView& view : calibration.views) {
    if (view.rms_px <= o.outlier_ratio * *middle) continue;
    list.push_back({Gravity::Doubt,
                    fmt::format("{} has {:.2f} px, {:.1f} times the median view", view.name,
                                view.rms_px, view.rms_px / *middle),
                    "look at it; leave it out if it is blurred or the board is bent"});
  }
}

void overfitted(const Calibration& calibration, const std::optional<HoldOut>& hold_out,
                const VerdictOptions& o, Objections& list) {
  if (!hold_out) {
    list.push_back({Gravity::Doubt, "no hold-out error: too few views", "add views"});
  } else if (hold_out->rms_px > o.hold_out_ratio * calibration.rms_px) {
    list.push_back({Gravity::Doubt,
                    fmt::format("views left out have {:.2f} px, the others {:.2f} px",
                                hold_out->rms_px, calibration.rms_px),
                    "add views, or choose a simpler lens model"});
  }
}

}  // namespace

void VerdictOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(fewest_views >= 3, "fewest_views: at least 3");
  require(enough_views >= fewest_views, "enough_views: not below fewest_views");
  require(tilt_rad >= 0 && tilt_rad < 1.5, "tilt_rad: 0 to 1.5");
  require(rms_doubted_px > 0, "rms_doubted_px: more than 0");
  require(rms_refused_px >= rms_doubted_px, "rms_refused_px: not below rms_doubted_px");
  require(coverage_refused >= 0 && coverage_refused <= 1, "coverage_refused: 0 to 1");
  require(coverage_doubted >= 0 && coverage_doubted <= 1, "coverage_doubted: 0 to 1");
  require(focal_doubt > 0, "focal_doubt: more than 0");
  require(hold_out_ratio >= 1, "hold_out_ratio: at least 1");
  require(outlier_ratio >= 1, "outlier_ratio: at least 1");
}

std::vector<Objection> objections(const std::vector<BoardView>& views,
                                  const VerdictOptions& options) {
  options.check();
  Objections list;
  too_few(views.size(), options, list);
  return list;
}

std::vector<Objection> objections(const Calibration& calibration, const Coverage& coverage,
                                  const std::optional<HoldOut>& hold_out,
                                  const VerdictOptions& options) {
  options.check();
  Objections list;
  too_few(calibration.views.size(), options, list);
  no_tilt(calibration, options, list);
  large_residuals(calibration, options, list);
  for (const Objection& objection : lens_objections(calibration.camera)) list.push_back(objection);
  uncertain(calibration, options, list);
  covered(coverage, options, list);
  standing_out(calibration, options, list);
  overfitted(calibration, hold_out, options, list);
  std::stable_partition(list.begin(), list.end(),
                        [](const Objection& o) { return o.gravity == Gravity::Refusal; });
  return list;
}

bool is_refused(const std::vector<Objection>& objections) {
  return std::any_of(objections.begin(), objections.end(),
                     [](const Objection& o) { return o.gravity == Gravity::Refusal; });
}

}  // namespace kestrel
