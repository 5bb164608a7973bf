#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "kestrel/link/command_messages.hpp"

namespace kestrel {

struct RequestOptions {
  double resend_s = 0.5;   // a command without an answer is sent again after this long
  int resends = 3;         // so many times
  double progress_s = 30;  // so long a command may stay in progress

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// What has become of a command.
enum class RequestState { Open, Accepted, Refused };

/// One command and its way to an acknowledgement (mavlink.io, "Command Protocol").
class CommandRequest {
 public:
  explicit CommandRequest(const mavlink::CommandLong& command, const RequestOptions& options = {})
      : options_(options), command_(command) {}

  /// The command when it is to be sent now, each time with the next `confirmation`. After the last
  /// one has gone unanswered for resend_s it is refused.
  std::optional<mavlink::CommandLong> due(double now_s);

  /// An answer to it, or to another command (then it changes nothing). "Temporarily rejected"
  /// leaves it open for the next try.
  void acknowledge(const mavlink::CommandAck& answer, double now_s);

  RequestState state() const { return state_; }
  double accepted_s() const { return answered_s_; }
  std::uint16_t command() const { return command_.command; }

  /// Why it was refused: "arm: denied", "mode: no answer to 4 tries"; empty when it was not.
  const std::string& words() const { return words_; }

 private:
  void refuse(const std::string& why);

  RequestOptions options_;
  mavlink::CommandLong command_;
  RequestState state_ = RequestState::Open;
  int sent_ = 0;
  double last_s_ = 0;
  double answered_s_ = 0;
  std::optional<double> in_progress_until_s_;
  bool put_off_ = false;
  std::string words_;
};

/// "accepted", "temporarily rejected", "denied", "not supported", "failed", "in progress",
/// "cancelled", or "result 17" (MAV_RESULT).
std::string result_name(std::uint8_t result);

}  // namespace kestrel
