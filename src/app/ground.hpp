#pragma once

#include <memory>
#include <optional>
#include <string>

#include "kestrel/ground/ground_station.hpp"

#include "arguments.hpp"
#include "task_setup.hpp"

namespace kestrel::app {

/// A ground station and the gate it opens and closes before the sink; none unless asked for.
class Ground {
 public:
  /// Serves the page when a port is asked for, and says on stderr, once, where it is and how to get
  /// in. The sink must outlive this, and what facts looks at. Throws std::runtime_error for a port
  /// or a token file that will not do.
  Ground(const GroundArguments& arguments, const Task& task, CommandSink& sink,
         Facts facts = nullptr);

  /// Where the chain sends: the gate, or without a ground station the sink itself.
  CommandSink& sink() { return gate_ ? *gate_ : sink_; }

  /// For Chain::ground; null without.
  GroundStation* station() { return station_.get(); }

 private:
  CommandSink& sink_;
  std::unique_ptr<CommandGate> gate_;
  std::unique_ptr<GroundStation> station_;
};

}  // namespace kestrel::app
