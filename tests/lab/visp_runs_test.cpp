// Whole runs of the benchmark against vpServo in ViSP's own simulator.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <visp3/robot/vpSimulatorCamera.h>
#include <visp3/visual_features/vpFeatureBuilder.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/vs/vpServo.h>

#include "kestrel/lab/run_metrics.hpp"

#include "lab/lab_setup.hpp"

namespace kestrel {
namespace {

vpHomogeneousMatrix visp_pose(const TargetPose& pose) {
  vpHomogeneousMatrix M;
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 3; ++column) {
      M[row][column] = pose.rotation(row, column);
    }
    M[row][3] = pose.translation[row];
  }
  return M;
}

/// e and v of each step of ViSP's loop; ends early where ViSP throws.
struct VispRun {
  std::vector<vpColVector> errors;
  std::vector<vpColVector> twists;
};

/// ViSP's own loop: vpServo, vpFeaturePoint, vpSimulatorCamera.
class VispLoop {
 public:
  VispLoop(const CameraSetup& setup, vpServo::vpServoIteractionMatrixType matrix)
      : cMo_(visp_pose(setup.scenario.start)) {
    const vpHomogeneousMatrix goal = visp_pose(setup.scenario.goal);
    for (const Eigen::Vector3d& p : setup.scenario.points_m) {
      vpPoint point(p.x(), p.y(), p.z());
      point.track(goal);
      vpFeatureBuilder::create(desired_[points_.size()], point);
      point.track(cMo_);
      vpFeatureBuilder::create(seen_[points_.size()], point);
      points_.push_back(point);
    }
    task_.setServo(vpServo::EYEINHAND_CAMERA);
    task_.setInteractionMatrixType(matrix);
    task_.setLambda(1);
    for (std::size_t i = 0; i < 4; ++i) task_.addFeature(seen_[i], desired_[i]);
    robot_.setSamplingTime(1 / setup.conditions.rate_hz);
    robot_.setMaxTranslationVelocity(1e9);
    robot_.setMaxRotationVelocity(1e9);
    robot_.getPosition(wMc_);
    wMo_ = wMc_ * cMo_;
  }

  VispRun run(int steps) {
    VispRun made;
    for (int k = 0; k < steps; ++k) {
      robot_.getPosition(wMc_);
      cMo_ = wMc_.inverse() * wMo_;
      for (std::size_t i = 0; i < 4; ++i) {
        points_[i].track(cMo_);
        if (points_[i].get_Z() <= .05) return made;  // the benchmark's collision
        vpFeatureBuilder::create(seen_[i], points_[i]);
      }
      const vpColVector v = task_.computeControlLaw();
      made.errors.push_back(task_.getError());
      made.twists.push_back(v);
      robot_.setVelocity(vpRobot::CAMERA_FRAME, v);
    }
    return made;
  }

 private:
  vpHomogeneousMatrix cMo_;
  vpHomogeneousMatrix wMc_;
  vpHomogeneousMatrix wMo_;
  std::vector<vpPoint> points_;
  vpFeaturePoint seen_[4];
  vpFeaturePoint desired_[4];
  vpServo task_;
  vpSimulatorCamera robot_;
};

/// First step after which |e| < 1e-3 for good; -1: never.
int settled_step(const VispRun& run) {
  int last_bad = -1;
  for (std::size_t k = 0; k < run.errors.size(); ++k) {
    if (std::sqrt(run.errors[k].sumSquare()) >= 1e-3) last_bad = int(k);
  }
  return last_bad + 1 < int(run.errors.size()) ? last_bad + 1 : -1;
}

struct Difference {
  double error = 0;
  double twist = 0;
};

Difference difference(const RunStep& step, const vpColVector& error, const vpColVector& twist) {
  Difference d;
  for (unsigned i = 0; i < 8; ++i) d.error = std::max(d.error, std::abs(step.error[i] - error[i]));
  const Vector6d v = step.twist.vector();
  for (unsigned i = 0; i < 6; ++i) d.twist = std::max(d.twist, std::abs(v[i] - twist[i]));
  return d;
}

TEST(VispRuns, AreTheLabsRuns) {
  const std::pair<Law, vpServo::vpServoIteractionMatrixType> laws[] = {
      {Law::Cur, vpServo::CURRENT}, {Law::Des, vpServo::DESIRED}, {Law::Mean, vpServo::MEAN}};
  int converged = 0;
  for (const char* scenario : {"S0_tutorial", "S1_small", "S3_rz90", "S5_rz160", "S8_trans"}) {
    for (const auto& [law, matrix] : laws) {
      const CameraSetup setup = test::benchmark_setup(scenario, law, 1500);
      const VispRun visp = VispLoop(setup, matrix).run(1500);
      RunMeter meter(setup);
      Difference worst;
      std::size_t k = 0;
      run_camera(setup, [&](const RunStep& step) {
        meter.add(step);
        if (k >= visp.errors.size()) return;
        const Difference d = difference(step, visp.errors[k], visp.twists[k]);
        worst = {std::max(worst.error, d.error), std::max(worst.twist, d.twist)};
        ++k;
      });
      // Rounding, times the condition number of up to some thousands for the twist.
      EXPECT_LT(worst.error, 1e-12) << scenario << ' ' << name(law);
      EXPECT_LT(worst.twist, 1e-11) << scenario << ' ' << name(law);
      const int settled = settled_step(visp);
      EXPECT_EQ(meter.metrics().k_error.value_or(-1), settled) << scenario << ' ' << name(law);
      converged += settled >= 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(converged, 14);  // all but desired under 160 deg, which collides
}

}  // namespace
}  // namespace kestrel
