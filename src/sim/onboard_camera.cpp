#include "kestrel/sim/onboard_camera.hpp"

#include <cmath>
#include <stdexcept>

#include "random.hpp"

namespace kestrel {
namespace {

const OnboardCameraOptions& checked(const OnboardCameraOptions& options) {
  options.imaging.check();
  return options;
}

}  // namespace

void ImagingOptions::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  RenderOptions render;
  render.noise_grey = noise_grey;
  render.vignetting = vignetting;
  render.check();
  shutter.check();
  vibration.check();
  require(gain_drift >= 0 && gain_drift < 1, "gain_drift: must be within [0, 1)");
  require(std::isfinite(gain_period_s) && gain_period_s > 0, "gain_period_s: must be positive");
  require(std::isfinite(latency_s) && latency_s >= 0, "latency_s: must not be negative");
  require(drop_share >= 0 && drop_share < 1, "drop_share: must be within [0, 1)");
}

OnboardCamera::OnboardCamera(const Scene& scene, const OnboardCameraOptions& options)
    : options_(checked(options)), renderer_(scene, options.camera) {}

Frame OnboardCamera::look(const TrueMotion& vehicle, std::int64_t index, double stamp_s) const {
  const ImagingOptions& imaging = options_.imaging;
  RenderOptions render;
  render.noise_grey = imaging.noise_grey;
  render.seed = options_.seed;
  render.frame = index;
  render.vignetting = imaging.vignetting;
  render.gain = 1 + imaging.gain_drift * std::sin(2 * M_PI * stamp_s / imaging.gain_period_s);
  Frame frame;
  frame.index = index;
  frame.stamp_s = stamp_s;
  frame.gray = renderer_.expose(shot({vehicle, options_.body_from_camera, imaging.vibration},
                                     stamp_s, renderer_, imaging.shutter),
                                render);
  return frame;
}

bool OnboardCamera::drops(std::int64_t index) const {
  const double share = options_.imaging.drop_share;
  if (share == 0 || index == 0) return false;  // the first frame is there
  sim_detail::RandomStream random(sim_detail::derived_seed(~options_.seed, std::uint64_t(index)));
  return random.uniform(0, 1) < share;
}

}  // namespace kestrel
