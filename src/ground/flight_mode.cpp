#include "kestrel/ground/flight_mode.hpp"

namespace kestrel {
namespace {

ModeChange start(FlightMode mode) {
  if (mode == FlightMode::Aborted) {
    return {mode, {Answer::Kind::Refused, "aborted: reset first, then start"}};
  }
  if (mode == FlightMode::Sticks) {
    return {mode, {Answer::Kind::Refused, "let go of the sticks first, then start"}};
  }
  const bool runs = mode == FlightMode::Servo;
  return {FlightMode::Servo, {Answer::Kind::Done, runs ? "servoing already" : "servoing"}};
}

ModeChange grip(FlightMode mode) {
  if (mode == FlightMode::Aborted) {
    return {mode, {Answer::Kind::Refused, "aborted: reset first, then take the sticks"}};
  }
  return {FlightMode::Sticks,
          {Answer::Kind::Done, "you have the sticks: zero velocity until you move them"}};
}

ModeChange hover(FlightMode mode) {
  if (mode == FlightMode::Aborted) {
    return {mode, {Answer::Kind::Done, "aborted: zero velocity already"}};
  }
  return {FlightMode::Hover, {Answer::Kind::Done, "hover: zero velocity until start"}};
}

ModeChange reset(FlightMode mode) {
  if (mode != FlightMode::Aborted) return {mode, {Answer::Kind::Refused, "nothing was aborted"}};
  return {FlightMode::Hover, {Answer::Kind::Done, "reset: hover until start"}};
}

}  // namespace

const char* name(FlightMode mode) {
  switch (mode) {
    case FlightMode::Hover:
      return "hover";
    case FlightMode::Servo:
      return "servo";
    case FlightMode::Sticks:
      return "sticks";
    case FlightMode::Aborted:
      return "aborted";
  }
  return "unknown";
}

ModeChange changed(FlightMode mode, Ask ask) {
  switch (ask) {
    case Ask::Abort:
      return {FlightMode::Aborted,
              {Answer::Kind::Done, "aborted: zero velocity, and it stays so until reset"}};
    case Ask::Hover:
      return hover(mode);
    case Ask::Reset:
      return reset(mode);
    case Ask::Start:
      return start(mode);
    case Ask::Grip:
      return grip(mode);
    default:
      return {mode, {}};
  }
}

}  // namespace kestrel
