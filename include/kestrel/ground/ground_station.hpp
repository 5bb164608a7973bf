#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kestrel/ground/access_token.hpp"
#include "kestrel/ground/command_gate.hpp"
#include "kestrel/ground/ground_desk.hpp"
#include "kestrel/ground/ground_view.hpp"
#include "kestrel/ground/tls_identity.hpp"

namespace kestrel {

/// Where the page is served and how much of it.
struct GroundOptions {
  std::string host = "127.0.0.1";  // a number; loopback: this machine only
  std::uint16_t port = 0;          // of the page and the streams; 0: any free one
  /// Of the commands, a port of their own: a browser holds six connections to a port, and with six
  /// streams open no command would get through. 0: the page's next, or any free one.
  std::uint16_t command_port = 0;
  /// Of the emergency stop and nothing else, so that no flood of commands stands in its way. 0: the
  /// page's next but one, or any free one.
  std::uint16_t stop_port = 0;
  int max_streams = 6;         // more are answered 503
  double commands_per_s = 20;  // of all pages together, stops apart; more are answered 429
  int jpeg_quality = 75;       // 1 to 100
  double request_s = 5;        // for the whole of a request, a handshake of TLS included; then cut
  std::optional<TlsIdentity> tls;  // of both ports; none: plain HTTP
  /// Plain HTTP beyond this machine, where whoever listens on the way reads the token.
  bool allows_plain = false;
  /// Why no command is taken, for a human; empty: commands are taken.
  std::string view_only;

  /// Throws std::invalid_argument that names the first option out of range; also for a host beyond
  /// this machine (not 127.x.x.x, ::1 or localhost) without TLS, unless that is allowed.
  void check() const;
};

/// What was refused since the start, requests.
struct GroundRefusals {
  long wrong_token = 0;
  long foreign = 0;    // of another page, or by a name that is no number
  long malformed = 0;  // no HTTP, no JSON, no command
  long too_many = 0;   // streams, commands a second
  long stale = 0;      // replayed
  long slow = 0;       // cut: not finished in time, or the answer not taken
  long huge = 0;       // longer than any request is
  long crowded = 0;    // cut for a newer connection, having shown no token
  long no_place = 0;   // a path that is not there
  long no_tls = 0;     // no TLS where TLS is spoken
  long view_only = 0;  // commands where none is taken
};

/// Each count with its name, in the order above.
std::vector<std::pair<std::string, long>> named(const GroundRefusals& refusals);

/// Something that is known of the vehicle or of the way to it, for a human.
struct Fact {
  enum class Tone { Plain, Warning };
  std::string name;   // "Battery"
  std::string words;  // "12.4 V"
  Tone tone = Tone::Plain;
};

/// What is known now; called by several threads, some ten times a second.
using Facts = std::function<std::vector<Fact>()>;

/// The ground station: a page in the browser that shows what the chain sees and takes commands to
/// GroundDesk. Its threads wait for viewers; the loop never does: it hands over a frame by a swap
/// of pointers, and each viewer is sent the newest when it has taken the one before.
///
/// Page and scripts are served to all; streams and commands need the token, and commands the page's
/// own origin where a browser tells one.
class GroundStation {
 public:
  /// Seconds on a clock that only goes forward; called by several threads.
  using Clock = std::function<double()>;

  /// Listens when this returns. Throws std::runtime_error when a port is taken, naming it, and as
  /// GroundOptions::check. The gate must outlive the station, and what facts looks at; null:
  /// nothing is known. by_hand: see GroundDesk; the station looks after it.
  GroundStation(const GroundOptions& options, const AccessToken& token, const Task& task,
                CommandGate& gate, Clock now_s, Facts facts = nullptr,
                OperatorLink* by_hand = nullptr);
  ~GroundStation();
  GroundStation(const GroundStation&) = delete;
  GroundStation& operator=(const GroundStation&) = delete;

  std::uint16_t port() const;
  std::uint16_t command_port() const;
  std::uint16_t stop_port() const;
  /// The page's address with the token, for its owner: "http://127.0.0.1:8080/#token=..."; https
  /// with TLS. What is
  /// behind # a browser sends to nobody.
  std::string address() const;

  GroundDesk& desk();
  GroundRefusals refusals() const;

  /// See GroundDesk: what of a frame's decision may be flown now.
  Decision steered(Decision decision, const DecisionState& before);

  /// Hands a frame to the viewers: a swap of pointers.
  void show(GroundView view);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kestrel
