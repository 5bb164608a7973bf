#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "kestrel/ground/ground_station.hpp"
#include "kestrel/link/operator_link.hpp"

#include "arguments.hpp"
#include "key_flight.hpp"
#include "task_setup.hpp"
#include "terminal_keys.hpp"

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

/// The operator's own link to a switch; null when none is asked for. Throws std::invalid_argument
/// and std::runtime_error for an address or a key file that will not do.
std::unique_ptr<OperatorLink> operator_link(const GroundArguments& arguments);

/// A ground station and the gate it opens and closes before the sink, none unless asked for; and
/// the keys of the terminal, which close it too.
class Ground {
 public:
  /// Serves the page when a port is asked for, and says on stderr, once, where it is and how to get
  /// in. The sink must outlive this, and what facts looks at. Throws std::runtime_error for a port,
  /// a token file or a certificate that will not do.
  Ground(const GroundArguments& arguments, const Task& task, CommandSink& sink,
         Facts facts = nullptr);

  /// Where the chain sends: the gate, or without a ground station and keys the sink itself.
  CommandSink& sink() { return gate_ ? *gate_ : sink_; }

  /// For Chain::ground; null without.
  GroundStation* station() { return station_.get(); }

  /// For Chain::steered; null where nobody steers.
  std::function<Decision(Decision, const DecisionState&)> steering();

 private:
  void serve(const GroundArguments& arguments, const Task& task, Facts facts);
  void listen_to_keys();

  CommandSink& sink_;
  std::unique_ptr<OperatorLink> link_;
  std::unique_ptr<CommandGate> gate_;
  std::unique_ptr<GroundStation> station_;
  std::unique_ptr<KeyFlight> key_flight_;  // without a page
  std::unique_ptr<TerminalKeys> keys_;
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
