#include "kestrel/link/command_request.hpp"

#include <cmath>
#include <iterator>
#include <stdexcept>

#include "kestrel/link/autopilot_profile.hpp"

namespace kestrel {
namespace {

constexpr std::uint8_t kAccepted = 0;
constexpr std::uint8_t kTemporarilyRejected = 1;
constexpr std::uint8_t kInProgress = 5;

}  // namespace

void RequestOptions::check() const {
  if (!(resend_s > 0 && std::isfinite(resend_s))) {
    throw std::invalid_argument("resend_s: must be finite and positive (s)");
  }
  if (resends < 0) throw std::invalid_argument("resends: must not be negative");
  if (!(progress_s > 0 && std::isfinite(progress_s))) {
    throw std::invalid_argument("progress_s: must be finite and positive (s)");
  }
}

std::string result_name(std::uint8_t result) {
  constexpr const char* kNames[] = {"accepted", "temporarily rejected", "denied",   "not supported",
                                    "failed",   "in progress",          "cancelled"};
  if (result < std::size(kNames)) return kNames[result];
  return "result " + std::to_string(result);
}

std::optional<mavlink::CommandLong> CommandRequest::due(double now_s) {
  if (state_ != RequestState::Open) return std::nullopt;
  if (in_progress_until_s_) {
    if (now_s > *in_progress_until_s_) refuse("has stayed in progress for too long");
    return std::nullopt;
  }
  if (sent_ > 0 && now_s - last_s_ < options_.resend_s) return std::nullopt;
  if (sent_ > options_.resends) {
    refuse(put_off_ ? "temporarily rejected, " + std::to_string(sent_) + " times"
                    : "no answer to " + std::to_string(sent_) + " tries");
    return std::nullopt;
  }
  mavlink::CommandLong command = command_;
  command.confirmation = std::uint8_t(sent_++);
  last_s_ = now_s;
  return command;
}

void CommandRequest::acknowledge(const mavlink::CommandAck& answer, double now_s) {
  // An answer before the question is one to somebody else's.
  const bool is_for_this = answer.command == command_.command && sent_ > 0;
  if (!is_for_this || state_ != RequestState::Open) return;
  if (answer.result == kInProgress) {
    if (!in_progress_until_s_) in_progress_until_s_ = now_s + options_.progress_s;
  } else if (answer.result == kTemporarilyRejected) {
    put_off_ = true;
    in_progress_until_s_.reset();
  } else if (answer.result == kAccepted) {
    state_ = RequestState::Accepted;
    answered_s_ = now_s;
  } else {
    refuse(result_name(answer.result));
  }
}

void CommandRequest::refuse(const std::string& why) {
  state_ = RequestState::Refused;
  words_ = command_name(command_.command) + ": " + why;
}

}  // namespace kestrel
