#pragma once

#include <optional>
#include <vector>

#include "kestrel/lab/helicopter_run.hpp"
#include "kestrel/lab/pixel_noise.hpp"

namespace kestrel {

/// The world's frame at this step of a run.
HelicopterFrame frame_at(const HelicopterSetup& setup, int step, const HelicopterState& state);

/// The camera levelled, with its heading, in World: where vp4 and its kin look through.
Transform<frame::World, frame::Camera> level_camera(const HelicopterSetup& setup,
                                                    const HelicopterFrame& frame);

/// What the law on a helicopter is told of the true world: points with their noise, late, depths
/// and translations with their factor, an attitude with its bias. The pose, for laws that need one,
/// is that of the noisy points nearest to the true one: the planar ambiguity is left out.
class HelicopterSight {
 public:
  explicit HelicopterSight(const HelicopterSetup& setup);

  /// Takes the image of the next frame; the noise is drawn here.
  void look(const HelicopterFrame& frame);

  /// What the law is told at the frame last looked at; empty when the target is not in the image it
  /// would be told of. The camera's motion is that since the image told before.
  std::optional<HelicopterLawInput> told();

 private:
  struct Image {
    HelicopterFrame frame;
    std::vector<Feature> measured;
    bool seen = true;
  };
  const Image& image(int step) const { return images_[std::size_t(step) % images_.size()]; }
  Transform<frame::World, frame::Camera> looked_through(const HelicopterFrame& frame) const;
  void add_pose(LawInput& input, const Image& image) const;

  HelicopterSetup setup_;
  PixelNoise noise_;
  std::vector<Feature> desired_;
  double goal_heading_rad_ = 0;
  std::vector<Image> images_;  // the last delay + 1, a ring
  int step_ = -1;
  std::optional<HelicopterFrame> told_;  // the frame of the image told last, while it is seen
};

}  // namespace kestrel
