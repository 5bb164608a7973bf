#include "kestrel/lab/start_poses.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "kestrel/lab/benchmark.hpp"

namespace kestrel {
namespace {

const Scenario& scenario() { return benchmark_scenarios().front(); }

TEST(StartPoses, SeeTheWholeTargetFromInsideTheBox) {
  StartBox box;
  box.margin_px = 10;
  const std::vector<StartPose> poses = start_poses(scenario(), {}, box, 7, 200);
  ASSERT_EQ(poses.size(), 200u);
  int rolled = 0;
  for (const StartPose& pose : poses) {
    EXPECT_TRUE((pose.translation_m.cwiseAbs().array() <= box.half_size_m.array()).all());
    const Scenario started = started_from(scenario(), pose);
    EXPECT_NO_THROW(started.check());
    // The axis leans by the tilt alone: the roll turns about it.
    EXPECT_GE(started.start_in_goal().rotation(2, 2), std::cos(box.largest_tilt_rad) - 1e-12);
    for (const Feature& point : seen_points(started.start, started.points_m)) {
      const Pixel px = LabCamera{}.to_pixel(point.at);
      EXPECT_GE(point.depth_m, box.nearest_m);
      EXPECT_GE(std::min(px.u, px.v), 10);
      EXPECT_LE(px.u, 630);
      EXPECT_LE(px.v, 470);
    }
    rolled += std::abs(pose.rotation_vector_rad.norm()) > M_PI / 2 ? 1 : 0;
  }
  EXPECT_NEAR(rolled, 100, 40);  // roll is uniform in +-180 deg: half beyond 90 deg, 5 sigma
}

// The image cuts all directions alike here: where the box is a point, the axis leans to all sides.
TEST(StartPoses, LeanToAllSides) {
  StartBox box;
  box.half_size_m = {0, 0, 0};
  int quadrants[4] = {};
  for (const StartPose& pose : start_poses(scenario(), {}, box, 3, 400)) {
    const Eigen::Vector3d axis = started_from(scenario(), pose).start_in_goal().rotation.col(2);
    ++quadrants[(axis.x() > 0 ? 1 : 0) + (axis.y() > 0 ? 2 : 0)];
  }
  for (const int count : quadrants) EXPECT_NEAR(count, 100, 44);  // 5 sigma of 400 draws
}

TEST(StartPoses, RepeatWithTheirSeed) {
  const std::vector<StartPose> few = start_poses(scenario(), {}, {}, 7, 5);
  const std::vector<StartPose> more = start_poses(scenario(), {}, {}, 7, 9);
  const std::vector<StartPose> others = start_poses(scenario(), {}, {}, 8, 5);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].translation_m, more[i].translation_m);
    EXPECT_EQ(few[i].rotation_vector_rad, more[i].rotation_vector_rad);
    EXPECT_NE(few[i].translation_m, others[i].translation_m);
  }
}

TEST(StartPoses, SayWhenTheTargetIsNeverSeen) {
  StartBox box;
  box.nearest_m = 100;
  box.tries = 100;
  EXPECT_THROW(start_poses(scenario(), {}, box, 1, 1), std::invalid_argument);
  box = {};
  box.half_size_m.x() = -1;
  EXPECT_THROW(box.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
