#include "calibrate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "kestrel/calibration/calibration_page.hpp"
#include "kestrel/calibration/calibration_table.hpp"
#include "kestrel/calibration/visp_config.hpp"
#include "kestrel/io/camera_writer.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/run_folder.hpp"

#include "calibrate_views.hpp"
#include "source_options.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

const std::vector<ReportFile> kFiles = {
    {"camera.xml", "the camera for ViSP and Kestrel"},
    {"camera_opencv.yaml", "the camera for OpenCV and Kestrel"},
    {"camera_ros.yaml", "the camera for ROS (camera_info) and Kestrel"},
    {"calibration.json", "all numbers, with every point and residual"}};

/// The command line over what ViSP's configuration file says.
struct Task {
  Board board;
  std::vector<std::string> inputs;
};

Task task_of(const CalibrateArguments& a) {
  Task task{{}, a.inputs};
  if (!a.visp_config.empty()) {
    const VispConfig config = load_visp_config(a.visp_config);
    task.board = config.board;
    if (task.inputs.empty() && !config.input.empty()) task.inputs = {config.input};
  }
  if (!a.board.empty()) task.board = parse_board(a.board);
  if (a.board.empty() && a.visp_config.empty())
    throw std::runtime_error("no board: give --board, for instance chessboard:9x6:0.025");
  if (task.inputs.empty())
    throw std::runtime_error("no pictures: give files, a folder, a video or camera:N");
  return task;
}

void write_results(const std::filesystem::path& folder, const CalibrateArguments& a,
                   const CalibrationResult& result, const ViewCollector& views) {
  write_text(folder / "calibration.json", calibration_json(result));
  if (!is_refused(result.objections))
    write_camera_files(folder, Camera(result.calibration->camera), a.name);
  Report report = calibration_report(result, views.largest_picture(), views.largest_view());
  report.files = files_of(folder, kFiles);
  write_text(folder / "report.html", report_html(report));
}

}  // namespace

void add_calibrate(CLI::App& app, const std::shared_ptr<CalibrateArguments>& a) {
  auto* verb = app.add_subcommand("calibrate",
                                  "Find a camera's focal lengths, centre and lens from pictures of "
                                  "a board; writes ViSP, OpenCV and ROS files and a report");
  verb->add_option(
      "INPUT,--input", a->inputs,
      "Pictures, folders, patterns like left%02d.jpg; or one video, camera:N, dc1394:, "
      "http://...: its frames are chosen as the board moves");
  verb->add_option("--board", a->board,
                   "chessboard:9x6:0.025 (inner corners, side of a square in m), circles:7x5:0.03 "
                   "(distance in m), acircles:4x11:0.02 (distance of rows in m) or "
                   "charuco:5x7:0.04:0.02:4X4_50 (squares, sides in m, markers; default 4X4_50)");
  verb->add_option("--visp-config", a->visp_config,
                   "Configuration of ViSP's calibration (default-chessboard.cfg): board and input");
  verb->add_option_function<std::string>(
          "--model", [a](const std::string& word) { a->model = camera_model_named(word).value(); },
          "Lens: none, radial (k1), radial-tangential (k1 k2 p1 p2; default), "
          "radial-tangential-k3 (OpenCV's five) or kannala-brandt (fisheye)")
      ->check(CLI::IsMember({"none", "radial", "radial-tangential", "radial-tangential-k3",
                             "kannala-brandt", "fisheye"}));
  verb->add_option("--output,--save", a->output,
                   "Folder to make (default runs/calibrate; a number is added when it exists)");
  verb->add_option("--camera-name", a->name, "Name of the camera in the files (default Camera)");
  verb->add_option("--views", a->views,
                   "How many views to collect from a video or camera, 4 to 60 (default 12)")
      ->check(CLI::Range(4, 60));
  add_capture(*verb, {a, &a->capture});
  verb->add_flag_callback(
      "--display", [a] { a->guide = Guide::Window; },
      "Of a video or camera, show in a window the board that is seen, where views are kept and "
      "what "
      "to show next; a right click ends the collecting (default: lines on the terminal only)");
  verb->add_flag_callback(
      "--no-visp", [a] { a->cross_check = CrossCheck::None; },
      "Do not let ViSP calibrate the same views to compare (default: it does)");
  verb->add_flag_callback(
      "--json", [a] { a->printed = Printed::Json; }, "Print JSON (default: tables)");
  verb->footer("Refused calibrations end with exit code 1 and leave no camera files.");
}

int run(const CalibrateArguments& a) {
  const Task task = task_of(a);
  GuideOptions guide;
  guide.views = a.views;
  const ViewCollector views = collect_views(task.inputs, task.board, guide, {a.guide, a.capture});
  if (views.size().width == 0)
    throw std::runtime_error("not one picture could be read; look at the lines above");
  CalibrationJob job{task.board, a.model, views.size(), views.views(), a.cross_check};
  const CalibrationResult result = calibrated(job);
  const auto folder = create_run_folder(a.output.empty() ? "runs/calibrate" : a.output);
  write_results(folder, a, result, views);
  fmt::print("{}",
             a.printed == Printed::Json ? calibration_json(result) : calibration_text(result));
  fmt::print(stderr, "written to {}: open report.html\n", folder.string());
  return is_refused(result.objections) ? 1 : 0;
}

}  // namespace kestrel::app
