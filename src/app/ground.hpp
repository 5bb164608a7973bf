#pragma once

#include <memory>
#include <optional>
#include <string>

#include "kestrel/ground/ground_station.hpp"

#include "arguments.hpp"
#include "task_setup.hpp"

namespace kestrel::app {

/// What a station is made of. Throws std::runtime_error for a certificate or a key that will not
/// do.
GroundOptions ground_options(const GroundArguments& arguments);

/// The token of the file, or a new one. Throws as load_token.
AccessToken ground_token(const GroundArguments& arguments);

/// Says on stderr where the page is and, unless it stands in a file, the token; the fingerprint of
/// a certificate that nobody vouches for. address: see GroundStation::address.
void announce(const std::string& address, const GroundOptions& options,
              const GroundArguments& arguments);

/// A ground station and the gate it opens and closes before the sink; none unless asked for.
class Ground {
 public:
  /// Serves the page when a port is asked for, and says on stderr, once, where it is and how to get
  /// in. The sink must outlive this, and what facts looks at. Throws std::runtime_error for a port,
  /// a token file or a certificate that will not do.
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

/// A sink of nothing.
class NoSink final : public CommandSink {
 public:
  void send(const VelocityCommand&, double) noexcept override {}
  long failures() const override { return 0; }
};

/// A task for where nothing is steered: of no vehicle and no target.
Task no_task();

/// A ground station where nothing flies: a page to look at, and every command is refused.
class OnlookerGround {
 public:
  /// As Ground; why: the words with which commands are refused.
  OnlookerGround(const GroundArguments& arguments, const std::string& why);

  /// Hands a frame to the viewers, if there is a page.
  void show(const Frame& frame, const LogRow& row, const Track& track, double chain_ms);

  bool is_there() const { return station_ != nullptr; }

 private:
  NoSink sink_;
  CommandGate gate_{sink_};
  std::unique_ptr<GroundStation> station_;
};

}  // namespace kestrel::app
