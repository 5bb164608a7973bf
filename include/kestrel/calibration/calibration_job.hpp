#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kestrel/calibration/calibration_verdict.hpp"
#include "kestrel/calibration/visp_solver.hpp"

namespace kestrel {

/// Who else calibrates the same views, to compare.
enum class CrossCheck { None, Visp };

/// What is to be calibrated.
struct CalibrationJob {
  Board board;
  CameraModel model = CameraModel::RadialTangential;
  ImageSize size;
  std::vector<BoardView> views;
  CrossCheck cross_check = CrossCheck::Visp;
  VerdictOptions verdict{};
};

/// All that is known when it is done.
struct CalibrationResult {
  CalibrationJob job;
  std::optional<Calibration> calibration;  // empty when there is no solution
  Coverage coverage;
  std::optional<HoldOut> hold_out;
  std::optional<VispCheck> visp;
  std::vector<Objection> objections;  // refusals first
};

/// Solves, tries on views left out, compares and judges. What cannot be solved is a refusal, not an
/// exception. Throws std::invalid_argument for a board or verdict options that do not check and for
/// an image without size, std::runtime_error when ViSP's module cannot be loaded.
CalibrationResult calibrated(const CalibrationJob& job);

}  // namespace kestrel
