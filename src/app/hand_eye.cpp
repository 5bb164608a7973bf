#include "kestrel/calibration/hand_eye.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/mount_picture.hpp"
#include "kestrel/io/run_folder.hpp"

#include "calibrate.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

/// The file of rows that an input names: itself, or the log of a run folder.
fs::path rows_of(const fs::path& input) {
  return fs::is_directory(input) ? input / "run.csv" : input;
}

}  // namespace

void add_hand_eye(CLI::App& calibrate, const std::shared_ptr<HandEyeArguments>& a) {
  auto* verb = calibrate.add_subcommand(
      "hand-eye",
      "Find how the camera is mounted from recorded attitudes and poses of a target that stands "
      "still; writes a mount file");
  verb->add_option("RUN,--input", a->input,
                   "Run folder of 'servo' or 'simulate', or a CSV file: stamp_s, roll_rad, "
                   "pitch_rad, yaw_rad, pose_tx_m .. pose_tz_m, pose_tux_rad .. pose_tuz_rad and, "
                   "where it is known, north_m, east_m, down_m")
      ->required();
  verb->add_option("--output,--save", a->output,
                   "Folder to make (default runs/hand_eye; a number is added when it exists)");
  verb->add_option("--translation", a->translation_m,
                   "Where the camera sits, x,y,z ahead of, right of and below the reference point, "
                   "m, for a recording without positions (default 0,0,0)")
      ->delimiter(',')
      ->expected(3);
  verb->footer("A refused calibration ends with exit code 1 and leaves no mount file.");
}

int run(const HandEyeArguments& a) {
  const std::vector<HandEyeStation> all = load_stations(rows_of(a.input));
  const std::vector<HandEyeStation> stations = chosen_stations(all);
  fmt::print(stderr, "{} of {} moments have an attitude of their own\n", stations.size(),
             all.size());
  const HandEyeResult result = hand_eye(stations);
  fmt::print("{}", hand_eye_text(result));
  if (is_refused(result.objections)) return 1;
  const fs::path folder = create_run_folder(a.output.empty() ? "runs/hand_eye" : a.output);
  const Eigen::Vector3d given(a.translation_m[0], a.translation_m[1], a.translation_m[2]);
  write_text(folder / "mount.yaml", hand_eye_mount(result, given));
  write_text(folder / "mount.svg", mount_picture(*result.body_from_camera, std::nullopt));
  fmt::print("  written         {}\n", (folder / "mount.yaml").string());
  return 0;
}

}  // namespace kestrel::app
