#include "kestrel/calibration/calibration_job.hpp"

namespace kestrel {

CalibrationResult calibrated(const CalibrationJob& job) {
  job.board.check();
  CalibrationResult result;
  result.job = job;
  result.coverage = coverage(job.views, job.size);
  result.objections = objections(job.views, job.verdict);
  if (is_refused(result.objections)) return result;
  try {
    result.calibration = solve_camera(job.views, job.board, job.size, job.model);
    result.hold_out = hold_out(job.views, job.board, job.size, job.model);
    if (job.cross_check == CrossCheck::Visp)
      result.visp = visp_check(job.views, job.board, job.size, job.model);
  } catch (const CalibrationError& error) {
    if (!result.calibration) {
      result.objections.insert(result.objections.begin(),
                               {Gravity::Refusal, "no camera is found", error.what()});
      return result;
    }
  }
  result.objections =
      objections(*result.calibration, result.coverage, result.hold_out, job.verdict);
  return result;
}

}  // namespace kestrel
