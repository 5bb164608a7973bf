#pragma once

#include "kestrel/calibration/calibration_job.hpp"

#include "board_views.hpp"

namespace kestrel::test {

/// A calibration of synthetic views, solved once for all who ask.
inline const CalibrationResult& made_up_result() {
  static const CalibrationResult result = [] {
    Random random("made-up result");
    CalibrationJob job;
    job.board = parse_board("chessboard:7x5:0.03");
    job.size = {640, 480};
    job.views = usual_views(job.board, wide_angle(), 8, 0.2, random);
    job.views[0].name = "left <01>.jpg";
    return calibrated(job);
  }();
  return result;
}

/// One that was refused before anything was solved.
inline CalibrationResult refused_result() {
  CalibrationJob job;
  job.size = {640, 480};
  job.views.resize(2);
  return calibrated(job);
}

}  // namespace kestrel::test
