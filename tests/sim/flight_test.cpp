// The whole loop through rendered images: world -> step -> world.

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "kestrel/loop/step.hpp"
#include "kestrel/sim/reference.hpp"
#include "kestrel/sim/texture.hpp"
#include "kestrel/sim/world.hpp"

namespace kestrel {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;

/// How a flight went.
struct Flight {
  HelicopterState end;
  int frames = 0;
  int lost = 0;         // frames without an answer
  double settle_s = 0;  // from here on within 0.10 m and 2 deg
  std::string log;      // every number of the trajectory, exactly
};

bool is_there(const HelicopterState& s) {
  return (s.position_m - Vector3d(-5, 0, 0)).norm() <= 0.10 && std::abs(s.yaw) <= 2 * kDegree;
}

Flight flown(WorldOptions options, double yaw) {
  const Scene scene = wall_scene(poster(1024, 768, 1));
  const TargetPose goal{Eigen::Matrix3d::Identity(), {0, 0, 5}};
  const Reference reference = goal_view(scene, options.camera, goal);
  Task task{options.camera};
  task.body_from_camera = options.body_from_camera;
  task.target_width_m = reference.width_m;
  task.target_height_m = reference.height_m;
  task.goal = goal * reference.target_from_template;
  task.check();
  const Template model(reference.image, reference.box, task.track.sift, task.track.match);
  options.start.yaw = yaw;
  World world(scene, options);
  Flight flight;
  std::ostringstream log;
  log << std::hexfloat;
  std::optional<LoopState> state;
  while (const auto frame = world.next()) {
    if (!state) state = start(model, *frame, task);
    const Step s = step(model, *frame, *state, task);
    state = s.next;
    world.send(s.decision.command, frame->stamp_s);
    ++flight.frames;
    flight.lost += !s.track.found();
    if (!is_there(world.state())) flight.settle_s = frame->stamp_s;
    log << world.state().position_m.transpose() << ' ' << world.state().yaw << ' '
        << s.decision.command.vector().transpose() << '\n';
  }
  flight.end = world.state();
  flight.log = log.str();
  return flight;
}

class Approach : public testing::TestWithParam<double> {};

TEST_P(Approach, EndsAtTheGoalByWhatTheCameraSees) {
  WorldOptions options;
  options.frames = 30 * 30;
  options.noise_grey = 2;
  const Flight flight = flown(options, GetParam() * kDegree);
  EXPECT_LT((flight.end.position_m - Vector3d(-5, 0, 0)).norm(), 0.10);
  EXPECT_LT(std::abs(flight.end.yaw), 2 * kDegree);
  EXPECT_LE(flight.lost, flight.frames / 50);
  RecordProperty("settle_s", std::to_string(flight.settle_s));
  RecordProperty("lost", flight.lost);
  std::ostringstream where;
  where << flight.end.position_m.transpose() << " m, yaw " << flight.end.yaw / kDegree << " deg";
  RecordProperty("end", where.str());
}

INSTANTIATE_TEST_SUITE_P(FromYaw, Approach, testing::Values(0.0, -12.0));

TEST(Flight, SameSeedSameFlightToTheBit) {
  WorldOptions options;
  options.frames = 90;
  options.noise_grey = 2;
  EXPECT_EQ(flown(options, 0).log, flown(options, 0).log);
}

}  // namespace
}  // namespace kestrel
