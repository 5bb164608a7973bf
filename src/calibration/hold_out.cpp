#include "kestrel/calibration/hold_out.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel {

std::optional<HoldOut> hold_out(const std::vector<BoardView>& views, const Board& board,
                                ImageSize size, CameraModel model, int folds) {
  constexpr int kFewestLeft = 4;
  const int count = int(views.size());
  folds = std::min(folds, count);
  if (folds < 2 || count - (count + folds - 1) / folds < kFewestLeft) return std::nullopt;
  double sum_px2 = 0;
  std::size_t points = 0;
  for (int fold = 0; fold < folds; ++fold) {
    std::vector<BoardView> kept;
    std::vector<BoardView> left_out;
    for (int i = 0; i < count; ++i)
      (i % folds == fold ? left_out : kept).push_back(views[std::size_t(i)]);
    try {
      const Camera camera(solve_camera(kept, board, size, model).camera);
      for (const BoardView& view : left_out) {
        const SolvedView seen = solve_view(view, board, camera);
        if (seen.residuals.empty()) return std::nullopt;
        sum_px2 += seen.rms_px * seen.rms_px * double(seen.residuals.size());
        points += seen.residuals.size();
      }
    } catch (const CalibrationError&) {
      return std::nullopt;
    }
  }
  return HoldOut{folds, std::sqrt(sum_px2 / double(points))};
}

}  // namespace kestrel
