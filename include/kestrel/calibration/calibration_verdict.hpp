#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kestrel/calibration/camera_solver.hpp"
#include "kestrel/calibration/coverage.hpp"
#include "kestrel/calibration/hold_out.hpp"

namespace kestrel {

/// How much an objection weighs.
enum class Gravity {
  Refusal,  // the camera is not to be used
  Doubt,    // it may be used, but could be better
};

/// Something that speaks against a calibration, and what to do about it.
struct Objection {
  Gravity gravity = Gravity::Doubt;
  std::string what;
  std::string remedy;
};

/// From where on a calibration is doubted, and refused.
struct VerdictOptions {
  int fewest_views = 4;         // fewer: refused
  int enough_views = 10;        // fewer: doubted
  double tilt_rad = 0.17;       // 10 degrees: views that differ less in tilt: refused
  double rms_refused_px = 2;    // for 640 px of width, in proportion beyond
  double rms_doubted_px = 0.8;  // the same
  double coverage_refused = 0.2;
  double coverage_doubted = 0.6;
  double focal_doubt = 0.01;    // standard deviation over focal length: doubted, tenfold: refused
  double hold_out_ratio = 1.5;  // hold-out over own rms, above it: doubted
  double outlier_ratio = 3;     // a view's rms over the median view's, above it: doubted

  /// Throws std::invalid_argument that names the first option out of its range.
  void check() const;
};

/// What speaks against the views alone, before anything is solved.
std::vector<Objection> objections(const std::vector<BoardView>& views,
                                  const VerdictOptions& options = {});

/// What speaks against a calibration, refusals first: too few views, none tilted against the
/// others, residuals too large, a focal length or centre that no usual camera has, values too
/// uncertain, a lens that folds inside the image, poor coverage, views that stand out, a model that
/// explains new views badly.
std::vector<Objection> objections(const Calibration& calibration, const Coverage& coverage,
                                  const std::optional<HoldOut>& hold_out,
                                  const VerdictOptions& options = {});

/// True when one of them is a refusal.
bool is_refused(const std::vector<Objection>& objections);

}  // namespace kestrel
