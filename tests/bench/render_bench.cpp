// What a frame of the onboard camera costs: 640x480, the default scene.
//
//     taskset -c 0 build/dev/render_bench
#include <array>
#include <cmath>

#include <benchmark/benchmark.h>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/sim/onboard_camera.hpp"
#include "kestrel/sim/texture.hpp"
#include "kestrel/sim/world.hpp"

namespace kestrel {
namespace {

const Scene& scene() {
  static const Scene it = wall_scene(poster(512, 384, 1));
  return it;
}

/// From here, turned to the right and then down, m and degrees.
TrueMotion at(double north_m, double down_m, double right_deg, double down_deg, double roll_deg) {
  constexpr double kDegree = M_PI / 180;
  TrueMotion motion;
  motion.world_from_body.rotation = rotation_from_vector({0, 0, right_deg * kDegree}) *
                                    rotation_from_vector({0, -down_deg * kDegree, 0}) *
                                    rotation_from_vector({roll_deg * kDegree, 0, 0});
  motion.world_from_body.translation = {north_m, 0, down_m};
  return motion;
}

void look(benchmark::State& state, const TrueMotion& motion, const ImagingOptions& imaging) {
  const OnboardCamera camera(scene(), {default_camera(), forward_mount(), imaging, 1});
  std::int64_t frame = 0;
  for (auto _ : state) benchmark::DoNotOptimize(camera.look(motion, frame++, 1.0).gray.data);
}

ImagingOptions noisy() {
  ImagingOptions imaging;
  imaging.noise_grey = 2;
  return imaging;
}

/// As in the missions.
ImagingOptions shaken() {
  ImagingOptions imaging = noisy();
  imaging.shutter.exposure_s = 0.004;
  imaging.vibration.amplitude_rad = Eigen::Vector3d(0.03, 0.03, 0.02) * M_PI / 180;
  imaging.vignetting = 0.2;
  return imaging;
}

void frontal(benchmark::State& state) {
  look(state, at(-double(state.range(0)), 0, 0, 0, 0), noisy());
}
void rolled(benchmark::State& state) { look(state, at(-6, 0, 5, 0, 30), noisy()); }
void oblique(benchmark::State& state) { look(state, at(-4, 0, 60, 0, 0), noisy()); }
void down_at_the_ground(benchmark::State& state) { look(state, at(-12, 1, 0, 60, 0), noisy()); }
void along_the_ground(benchmark::State& state) { look(state, at(-25, 3, 0, 5, 0), noisy()); }
void without_noise(benchmark::State& state) { look(state, at(-6, 0, 0, 0, 0), {}); }
void shaken(benchmark::State& state) {
  TrueMotion motion = at(-6, 0, 5, 0, 3);
  motion.velocity_m_s = {0.5, 0.3, 0};
  motion.rate_rad_s = {0.05, 0.05, 0.02};
  look(state, motion, shaken());
}
void learned_scales(benchmark::State& state) {
  for (auto _ : state) {
    const Renderer renderer(scene(), default_camera());
    benchmark::DoNotOptimize(renderer.view(at(-9, 0, 0, 0, 0).world_from_body * forward_mount()));
  }
}

BENCHMARK(frontal)->Arg(3)->Arg(5)->Arg(9)->Arg(15)->Unit(benchmark::kMillisecond);
BENCHMARK(rolled)->Unit(benchmark::kMillisecond);
BENCHMARK(oblique)->Unit(benchmark::kMillisecond);
BENCHMARK(down_at_the_ground)->Unit(benchmark::kMillisecond);
BENCHMARK(along_the_ground)->Unit(benchmark::kMillisecond);
BENCHMARK(without_noise)->Unit(benchmark::kMillisecond);
BENCHMARK(shaken)->Unit(benchmark::kMillisecond);
BENCHMARK(learned_scales)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kestrel

BENCHMARK_MAIN();
