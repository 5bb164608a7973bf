#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/frame.hpp"
#include "kestrel/link/sequence.hpp"
#include "kestrel/link/setpoint.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// A command that may be obeyed, and what its frame says of it.
struct ReceivedCommand {
  VelocityCommand command;
  std::uint32_t time_boot_ms = 0;
  mavlink::Envelope envelope;
};

/// What became of all that arrived.
struct ReceiverCounts {
  long datagrams = 0;
  long commands = 0;      // handed on
  long heartbeats = 0;    // neither late nor double
  long lost = 0;          // skipped by the sequence numbers, and not come late
  long late = 0;          // overtaken by a newer frame: not obeyed
  long duplicates = 0;    // not obeyed
  long not_finite = 0;    // setpoints with a NaN or an infinity
  long unsupported = 0;   // setpoints of another frame or type mask
  long misaddressed = 0;  // setpoints for another vehicle
  std::array<long, mavlink::kRefusals> refused{};

  /// Stretches of bytes that were no frame to be read, by reason.
  long refused_as(mavlink::Refusal reason) const { return refused[std::size_t(reason)]; }
  /// The same without UnknownMessage, which is no fault.
  long malformed() const;
};

/// What a receiver makes of datagrams, one after the other: the part of CommandReceiver that needs
/// no socket. Senders are told apart by address and ids, so that one that restarts is new. It
/// remembers the kMaxSenders heard of last, whoever floods it.
class ReceiverState {
 public:
  static constexpr std::size_t kMaxSenders = 64;

  /// `me` is the system and component that commands must be for.
  explicit ReceiverState(const Recipient& me = {}) : me_(me) {}

  /// The commands in a datagram, in its order. Nothing of it is kept for the next one.
  std::vector<ReceivedCommand> take(Bytes datagram, const Address& from);

  const ReceiverCounts& counts() const { return counts_; }

 private:
  using SenderId = std::tuple<Address, std::uint8_t, std::uint8_t>;
  struct Sender {
    SequenceWindow sequence;
    long last_heard = 0;  // number of the datagram
  };

  std::optional<ReceivedCommand> accept(const mavlink::Packet& packet, const Address& from);
  std::optional<ReceivedCommand> accept_setpoint(const mavlink::SetPositionTarget& setpoint,
                                                 const mavlink::Envelope& envelope);
  bool is_new(const mavlink::Envelope& envelope, const Address& from);
  Sender& sender(const SenderId& id);

  Recipient me_;
  ReceiverCounts counts_;
  std::map<SenderId, Sender> senders_;
};

}  // namespace kestrel
