#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/ground/ground_desk.hpp"

#include "loop/camera_view.hpp"
#include "loop/flight.hpp"

namespace kestrel::test {

/// What left the gate.
struct Written final : CommandSink {
  std::vector<VelocityCommand> all;
  void send(const VelocityCommand& command, double) noexcept override { all.push_back(command); }
  long failures() const override { return 0; }
};

/// A desk, and two viewers of which the first has the command.
class Desk : public testing::Test {
 protected:
  Desk() {
    first_ = desk_.handle(asked(Ask::Join, ""), 0).client;
    second_ = desk_.handle(asked(Ask::Join, ""), 0).client;
    EXPECT_EQ(give(Ask::Take).kind, Answer::Kind::Done);
  }

  GroundCommand asked(Ask ask, const std::string& client) {
    GroundCommand command;
    command.ask = ask;
    command.client = client;
    command.number = ++number_;
    return command;
  }
  Answer give(Ask ask) { return desk_.handle(asked(ask, first_), 0).answer; }

  /// A frame in which the camera stands before the target.
  void show(std::int64_t index, const std::optional<TargetPose>& seen) {
    auto view = std::make_shared<GroundView>();
    view->row.frame = index;
    view->row.stamp_s = double(index) / 30;
    view->gray = picture();
    view->seen = seen;
    desk_.show(view);
  }

  const Task task_ = test::example_task(test::forward_camera());
  static const cv::Mat& picture() {  // painted once
    static const Task task = test::example_task(test::forward_camera());
    static const cv::Mat painted = test::view(task.camera, task.goal);
    return painted;
  }
  Written written_;
  CommandGate gate_{written_};
  GroundDesk desk_{task_, gate_, "run"};
  std::string first_;
  std::string second_;
  std::uint64_t number_ = 0;
};

}  // namespace kestrel::test
