#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/ground/ground_station.hpp"  // before the client: a macro of its library's

#include "ground/station_client.hpp"
#include "loop/camera_view.hpp"
#include "loop/flight.hpp"

namespace kestrel::test {

/// Keeps what is sent.
struct KeptCommands final : CommandSink {
  std::vector<VelocityCommand> all;
  void send(const VelocityCommand& command, double) noexcept override { all.push_back(command); }
  long failures() const override { return 0; }
};

/// What a station needs, whose clock stands still.
class IdleStation : public testing::Test {
 protected:
  std::unique_ptr<GroundStation> station(const GroundOptions& options) {
    return std::make_unique<GroundStation>(options, token_, task_, gate_, [] { return 0.0; });
  }

  /// Waits for what other threads do; the limit is reached only when something is broken.
  static bool comes(const std::function<bool()>& happens) {
    for (int i = 0; i < 2000; ++i) {
      if (happens()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }

  const Task task_ = example_task(forward_camera());
  const AccessToken token_ = random_token();
  KeptCommands sent_;
  CommandGate gate_{sent_};
};

}  // namespace kestrel::test
