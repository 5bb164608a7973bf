#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/link/signature_checker.hpp"
#include "kestrel/link/signing.hpp"
#include "kestrel/link/socket.hpp"
#include "kestrel/link/switch_operator.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// Who speaks to which switch about which vehicle.
struct OperatorLinkOptions {
  Recipient vehicle{1, 1};
  Recipient self{1, 192};        // the switch
  std::uint8_t system_id = 255;  // a ground station's
  std::uint8_t component_id =
      190;  // MAV_COMP_ID_MISSIONPLANNER, as ground stations call themselves
  std::optional<mavlink::SigningKey>
      key;                         // of the switch's link; then frames are signed, both ways
  std::function<double()> unix_s;  // seconds since 1970, for signatures: needed with a key

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// An operator's own link to a switch, of role `ground` there: velocities of a hand, and take-over,
/// release, emergency stop and reset. A SwitchOperator with a socket and link_clock_s(); it has no
/// thread, so look_after() is to be called some fifty times a second. Any thread may call anything.
class OperatorLink final : public CommandSink {
 public:
  /// Throws as UdpSocket::connected_to and OperatorLinkOptions::check.
  OperatorLink(const Address& to, const OperatorLinkOptions& options);

  /// Zero velocity and release when something is held; waits for the answer, half a second at most.
  ~OperatorLink() override;
  OperatorLink(const OperatorLink&) = delete;
  OperatorLink& operator=(const OperatorLink&) = delete;

  /// A velocity of the hand, dated now, whatever frame it came with: it rests on none. Not finite:
  /// zero.
  void send(const VelocityCommand& command, double stamp_s) noexcept override;

  /// Datagrams that the network did not take, or sent where nobody listens.
  long failures() const override { return failures_; }

  void take_over();
  void zero();     // a zero velocity
  void release();  // a zero velocity, then release of what was taken over
  void stop();     // a zero velocity, then the emergency stop
  void reset();

  /// Listens, asks again what was not answered, and says once a second that it is there.
  void look_after();

  OperatorStatus status() const;
  /// What the switch answered since the last call, for a human.
  std::vector<std::string> take_words();

  /// Where it speaks to, and this end.
  const Address& to() const { return to_; }
  const Address& local() const { return socket_.local(); }

 private:
  void transmit(const mavlink::Message& message);
  void transmit_due();
  void hear(Bytes datagram);
  bool is_genuine(const mavlink::FrameView& frame);
  mavlink::SigningStamp stamp();

  const Address to_;
  const OperatorLinkOptions options_;
  mutable std::mutex mutex_;
  UdpSocket socket_;
  SwitchOperator operator_;
  std::optional<mavlink::SignatureChecker> checker_;
  std::uint64_t last_signing_time_ = 0;
  std::uint8_t sequence_ = 0;
  std::optional<double> next_heartbeat_s_;
  std::atomic<long> failures_{0};
};

}  // namespace kestrel
