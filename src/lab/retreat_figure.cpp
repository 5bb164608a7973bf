#include <algorithm>
#include <cmath>

#include "kestrel/lab/lab_figures.hpp"

#include "figure_parts.hpp"

// Retreat over the angle, see lab_figures.hpp.
namespace kestrel {
namespace {

/// Beyond it the curve leaves the paper: 165 deg.
constexpr double kLargestAngle = 2.8797932657906435;

/// The angle (rad) of a start that is a pure rotation about the optical axis; else none.
std::optional<double> roll_of(const LabScene& scene) {
  const Eigen::Matrix3d& R = scene.start.axes;
  const bool turns_only = scene.kind == RunKind::Camera && R(2, 2) > 1 - 1e-9 &&
                          (scene.start.origin_m - scene.goal.origin_m).norm() < 1e-9;
  const double angle = std::abs(std::atan2(R(1, 0), R(0, 0)));
  if (!turns_only || angle < 1e-6 || angle > kLargestAngle) return std::nullopt;
  return angle;
}

struct Turn {
  double angle_rad = 0;
  const LabScene* scene = nullptr;
};

std::vector<Turn> turns_of(const LabReport& report) {
  std::vector<Turn> out;
  for (const LabScene& scene : report.scenes) {
    if (const auto angle = roll_of(scene)) out.push_back({*angle, &scene});
  }
  std::sort(out.begin(), out.end(),
            [](const Turn& a, const Turn& b) { return a.angle_rad < b.angle_rad; });
  return out;
}

Series retreat_of(const LabReport& report, const std::string& law, int place,
                  const std::vector<Turn>& turns) {
  Series line{law, {}, {}, place, figures::stroke_of(place)};
  for (const Turn& turn : turns) {
    for (const LabRun& run : report.runs) {
      const bool wanted = run.law == law && run.scenario == turn.scene->scenario &&
                          run.modifier.empty() && run.end == RunEnd::Converged;
      const auto retreat_m = figure(run, "retreat_m");
      if (!wanted || !retreat_m) continue;
      line.x.push_back(turn.angle_rad * 180 / M_PI);
      line.y.push_back(*retreat_m);
    }
  }
  return line;
}

Series analytic_retreat(const std::vector<Turn>& turns) {
  Series line{"Z*(1/cos(θ/2) − 1)", {}, {}, -1, Stroke::Faint};
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const auto& points = turns.front().scene->points_m;
  for (const Eigen::Vector3d& p : points) centre += p / double(points.size());
  const double distance_m = (centre - turns.front().scene->goal.origin_m).norm();
  const double last = turns.back().angle_rad;
  for (int i = 0; i <= 60; ++i) {
    const double angle = last * i / 60;
    line.x.push_back(angle * 180 / M_PI);
    line.y.push_back(distance_m * (1 / std::cos(angle / 2) - 1));
  }
  return line;
}

}  // namespace

std::string retreat_figure(const LabReport& report) {
  const std::vector<Turn> turns = turns_of(report);
  if (turns.size() < 2) return "";
  Plot plot;
  plot.title = "Retreat over the angle about the optical axis";
  plot.x_label = "initial angle (deg)";
  plot.y_label = "retreat (m)";
  plot.names = Plot::Names::LineEnds;
  plot.height_px = 400;
  plot.series.push_back(analytic_retreat(turns));
  const LabNames laws = laws_of(report.runs);
  for (const std::string& law : laws.all()) {
    Series line = retreat_of(report, law, laws.place(law), turns);
    const bool retreats =
        std::any_of(line.y.begin(), line.y.end(), [](double m) { return m > 1e-3; });
    if (retreats) plot.series.push_back(std::move(line));
  }
  return svg_plot(plot);
}

}  // namespace kestrel
