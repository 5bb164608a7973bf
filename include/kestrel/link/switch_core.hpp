#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "kestrel/link/address.hpp"
#include "kestrel/link/bytes.hpp"
#include "kestrel/link/command_desk.hpp"
#include "kestrel/link/control_word.hpp"
#include "kestrel/link/frame.hpp"
#include "kestrel/link/outbox.hpp"
#include "kestrel/link/router.hpp"
#include "kestrel/link/signature_checker.hpp"
#include "kestrel/link/stream_parser.hpp"
#include "kestrel/link/switch_log.hpp"
#include "kestrel/link/switch_options.hpp"
#include "kestrel/link/switch_status.hpp"
#include "kestrel/link/token_bucket.hpp"

namespace kestrel {

/// One moment, by two clocks.
struct SwitchTime {
  double now_s = 0;   // monotonic: every age and deadline
  double unix_s = 0;  // of the wall: signatures only
};

/// The switching layer without its sockets: what each peer says comes in, what each is to be told
/// goes out. Nothing in it blocks, throws in flight, reads a clock or grows without bound.
///
/// Flight control hears three things: the setpoints of the CommandDesk, what FlightRules lets pass,
/// and the heartbeats of the switch, whose custom_mode is the ControlWord.
class SwitchCore {
 public:
  /// Throws std::invalid_argument as SwitchOptions::check.
  explicit SwitchCore(SwitchOptions options);

  /// A new peer behind a link (its index in the options). Beyond max_peers of that link it is not
  /// heard.
  void connect(PeerId peer, std::size_t link, const Address& from, SwitchTime time);

  /// The peer is gone, and with it what was known of it. If it had control, the next call brings
  /// the zero.
  void disconnect(PeerId peer, SwitchTime time);

  /// What follows from a datagram, or a piece of a stream, of a peer: a setpoint that is obeyed
  /// goes to flight control at once. The deliveries live until the next call.
  const std::vector<Delivery>& receive(PeerId peer, Bytes bytes, SwitchTime time);

  /// What is due: the setpoint to flight control at rate_hz, zeros at the deadman, heartbeats. May
  /// be called as often as wanted, at least at rate_hz.
  const std::vector<Delivery>& tick(SwitchTime time);

  /// A zero for flight control. From here on nothing but zeros is sent to it.
  const std::vector<Delivery>& shutdown(SwitchTime time);

  SwitchStatus status(SwitchTime time) const;

  /// Events since the last call, oldest first; at most SwitchLog::kMost are kept.
  std::vector<SwitchEvent> take_events() { return log_.take(); }

 private:
  struct Peer {
    PeerStatus status;
    TokenBucket bucket;
    std::unique_ptr<mavlink::StreamParser> stream;  // none for datagrams
  };

  const SwitchLink& link_of(const Peer& peer) const { return options_.links[peer.status.link]; }
  ControlWord control() const;
  Claimant claimant(const Peer& peer, const mavlink::Envelope& envelope) const;
  Addressee addressee(const Peer& peer) const;

  void receive_datagram(Peer& peer, Bytes bytes, SwitchTime time);
  void receive_stream(Peer& peer, Bytes bytes, SwitchTime time);
  void count(Peer& peer, Refused reason, SwitchTime time);
  void take(Peer& peer, const mavlink::Parsed& parsed, SwitchTime time);
  std::optional<Refused> take_frame(Peer& peer, const mavlink::FrameView& frame, SwitchTime time);
  std::optional<Refused> refused_signature(const Peer& peer, const mavlink::FrameView& frame,
                                           SwitchTime time);
  std::optional<Refused> take_known(Peer& peer, const mavlink::FrameView& frame, SwitchTime time);
  std::optional<Refused> take_setpoint(Peer& peer, const mavlink::FrameView& frame, Arrival arrival,
                                       SwitchTime time);
  std::optional<Refused> take_control(Peer& peer, const mavlink::FrameView& frame, Arrival arrival,
                                      SwitchTime time);
  std::optional<Refused> forward(Peer& peer, const mavlink::FrameView& frame, Arrival arrival,
                                 SwitchTime time);
  std::optional<Refused> refused_to_flight(const Peer& peer, const mavlink::FrameView& frame,
                                           Arrival arrival) const;

  void send_due(SwitchTime time);
  void send_heartbeats(SwitchTime time);
  void note_changes(SwitchTime time);
  mavlink::Envelope next_envelope() {
    return {options_.self.system_id, options_.self.component_id, sequence_++};
  }

  SwitchOptions options_;
  Router router_;
  CommandDesk desk_;
  Outbox outbox_;
  SwitchLog log_;
  std::vector<std::optional<mavlink::SignatureChecker>> checkers_;  // of each link
  std::map<PeerId, Peer> peers_;
  std::vector<PeerCounters> departed_;  // of each link
  std::optional<SourceId> owner_;       // as last logged
  std::uint64_t deadman_count_ = 0;
  double next_heartbeat_s_ = -1e300;
  std::uint8_t sequence_ = 0, owner_sequence_ = 0;
  bool is_shut_ = false;
  std::uint64_t unknown_peer_chunks_ = 0;
};

}  // namespace kestrel
