#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "kestrel/io/sequence_writer.hpp"
#include "kestrel/sim/scene.hpp"
#include "kestrel/sim/world.hpp"

namespace kestrel::app {

/// What the camera of a simulated flight saw, kept as a sequence with truth.
class FlightFilm {
 public:
  /// Nothing is written before the first frame. The scene outlives the film. Throws as
  /// require_new_sequence.
  FlightFilm(std::filesystem::path folder, std::string name, const Scene& scene,
             const WorldOptions& options);

  /// The frame that the world gave last. The template is the largest upright rectangle found inside
  /// the target in the first one; it throws std::runtime_error when that is below 16 px, and what
  /// SequenceWriter throws. Frames in which less than half of the target is seen are not labelled.
  void record(const Frame& frame, const World& world);

 private:
  void begin(const TargetPose& camera_from_target);

  std::filesystem::path folder_;
  std::string name_;
  const Scene& scene_;
  Camera camera_;
  double rate_hz_;
  TargetPose first_;                            // camera_from_target of the first frame
  std::array<Eigen::Vector3d, 4> on_target_{};  // the template's corners, m
  std::optional<SequenceWriter> writer_;
};

}  // namespace kestrel::app
