#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "kestrel/calibration/calibration_job.hpp"
#include "kestrel/io/live_options.hpp"

#include "compare.hpp"

namespace kestrel::app {

/// How whoever holds the board before a camera is told what to show next.
enum class Guide {
  Lines,   // on the terminal
  Window,  // there and in a window
};

/// What `calibrate` was asked to do.
struct CalibrateArguments {
  std::vector<std::string> inputs;  // pictures, folders, patterns, videos, or one live camera
  std::string board;
  std::filesystem::path visp_config;
  CameraModel model = CameraModel::RadialTangential;
  std::filesystem::path output;  // empty: runs/calibrate
  std::string name = "Camera";   // of the camera, in the files
  int views = 12;                // to collect from a video or camera
  CaptureSettings capture;       // of a live camera
  Guide guide = Guide::Lines;
  CrossCheck cross_check = CrossCheck::Visp;
  Printed printed = Printed::Tables;
};

/// What `calibrate hand-eye` was asked to do.
struct HandEyeArguments {
  std::filesystem::path input;                    // run folder or CSV
  std::filesystem::path output;                   // empty: runs/hand_eye
  std::vector<double> translation_m = {0, 0, 0};  // of a recording without positions
};

/// Puts the verb below `calibrate`.
void add_hand_eye(CLI::App& calibrate, const std::shared_ptr<HandEyeArguments>& arguments);

/// Puts the verb and its options on a command line.
void add_calibrate(CLI::App& app, const std::shared_ptr<CalibrateArguments>& arguments);

}  // namespace kestrel::app
