#include "key_flight.hpp"

#include <optional>
#include <utility>

#include "kestrel/ground/hand_flight.hpp"

namespace kestrel::app {
namespace {

std::optional<Ask> asked_by(const std::string& typed) {
  if (typed.find(' ') != std::string::npos) return Ask::Abort;
  if (typed == "r") return Ask::Reset;
  if (typed == "s") return Ask::Start;
  return std::nullopt;
}

}  // namespace

KeyFlight::KeyFlight(CommandGate& gate) : gate_(gate) { gate_.open(); }

std::string KeyFlight::press(const std::string& typed) {
  const auto ask = asked_by(typed);
  if (!ask) return {};
  const std::lock_guard<std::mutex> lock(mutex_);
  const ModeChange change = changed(mode_, *ask);
  if (change.mode == FlightMode::Servo) {
    gate_.open();
  } else {
    gate_.close();
  }
  mode_ = change.mode;
  return change.answer.words;
}

Decision KeyFlight::steered(Decision decision) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return mode_ == FlightMode::Servo ? decision : stopped(std::move(decision));
}

}  // namespace kestrel::app
