#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/io/svg_space.hpp"
#include "kestrel/lab/lab_run.hpp"

namespace kestrel {

/// Where the runs of a scenario took place, in the space its paths are drawn in: the camera at its
/// goal (RunKind::Camera), north-east-down of the world (RunKind::Helicopter).
struct LabScene {
  std::string scenario;  // as LabRun::scenario
  RunKind kind = RunKind::Camera;
  std::vector<Eigen::Vector3d> points_m{};  // of the target, in order around its outline
  SpaceFrame start{"start"};                // of the camera
  SpaceFrame goal{"goal"};
  std::vector<Pixel> goal_px{};  // the points seen from the goal
  double focal_px = 600;
  int width_px = 640;
  int height_px = 480;
  /// Limits of the velocities that are drawn, by the names of their columns without prefix
  /// ("vx_m_s", "forward_m_s"); none: no limits.
  std::vector<std::pair<std::string, double>> limits{};
};

/// Share of the starts from which a law reached the goal.
struct LabBasin {
  std::string law;
  int reached = 0;
  int poses = 0;
  double low = std::numeric_limits<double>::quiet_NaN();  // of an interval of the share, 0 to 1
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// One law over two swept parameters; cells[row of y][column of x].
struct LabMap {
  std::string title;  // "depth factor x noise, S0_tutorial"
  std::string law;
  std::string x_label;
  std::string y_label;
  std::vector<double> x{};
  std::vector<double> y{};
  struct Cell {
    std::optional<double> value{};  // as value_label says; empty: the end counts
    RunEnd end = RunEnd::TimedOut;
  };
  std::vector<std::vector<Cell>> cells{};
  std::string value_label = "steps to converge";
};

/// How far the gain may rise, and the image be late, before a law fails.
struct LabMargin {
  std::string scenario;
  std::string law;
  std::optional<double> gain_per_s{};
  std::optional<double> delay_frames{};
};

/// Slope of log |J^+ e - xi| over log |xi| (servo.md, order of accuracy).
struct LabOrder {
  std::string law;
  std::optional<double> slope{};
};

/// What a reader should know of a law.
struct LabSheet {
  std::string law;
  std::string formula{};
  std::string needs{};
  std::string source{};
  std::string use{};
  std::string breaks{};
};

/// All that the page of a laboratory shows. Laws, scenarios and modifiers stand in the order in
/// which the runs bring them.
struct LabReport {
  std::string title = "Kestrel: comparison of control laws";
  std::string what{};  // a paragraph
  std::vector<std::string> remarks{};
  std::vector<LabScene> scenes{};
  std::vector<LabRun> runs{};
  std::vector<LabBasin> basins{};
  std::vector<LabMap> maps{};
  std::vector<LabMargin> margins{};
  std::vector<LabOrder> orders{};
  std::vector<LabSheet> sheets{};
  std::string commands{};  // that make all this again
  std::string configuration{};
};

/// A figure of a run by its name; empty when it has none.
std::optional<double> figure(const LabRun& run, const std::string& name);

/// The words of an end as a reader likes them: "local minimum"; with the reason of a refusal.
std::string end_words(const LabRun& run);

/// What the tables say of a run: the step it converged at (helicopter: the seconds), else the end.
std::string outcome(const LabRun& run);

/// Names in the order they first come.
class LabNames {
 public:
  int add(const std::string& name);          // its place, new or old
  int place(const std::string& name) const;  // -1: not there
  const std::vector<std::string>& all() const { return names_; }

 private:
  std::vector<std::string> names_;
};

LabNames laws_of(const std::vector<LabRun>& runs);
LabNames scenarios_of(const std::vector<LabRun>& runs);
LabNames modifiers_of(const std::vector<LabRun>& runs);

/// The scene of that scenario; null when there is none.
const LabScene* scene_named(const LabReport& report, const std::string& scenario);

}  // namespace kestrel
