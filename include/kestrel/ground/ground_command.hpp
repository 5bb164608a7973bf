#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/ground/flight_scene.hpp"
#include "kestrel/vehicle/velocity_command.hpp"

namespace kestrel {

/// What a viewer may ask for.
enum class Ask {
  Abort,     // "abort": zero velocity, and it stays so; from anybody
  Hover,     // "hover": zero velocity until the next start; from anybody
  Join,      // "join": a name to be known by; from anybody
  Take,      // "take": command of the vehicle
  Release,   // "release": give it up, to whoever asked for it
  Alive,     // "alive": the commander is still there
  Start,     // "start": servo
  Reset,     // "reset": after abort; hover
  HoldView,  // "hold_view": the pose seen now is the goal
  Gain,      // "gain": gain_per_s
  Freeze,    // "freeze": keep the picture of `frame` to choose a template in
  Examine,   // "examine": how good a template is `box` of the frozen picture
  Use,       // "use": the template examined last, `width_m` wide
  Grip,      // "grip": take the sticks; zero velocity until they are moved
  Sticks,    // "sticks": where the sticks are, ten times a second or more: `velocity`
  Law,       // "law": servo by `law`
  Limits,    // "limits": the largest velocities, `velocity`
  Goal,      // "goal": the vehicle is to be at `goal`
};

inline constexpr std::array<Ask, 18> kAsks{
    Ask::Abort, Ask::Hover, Ask::Join,     Ask::Take, Ask::Release, Ask::Alive,
    Ask::Start, Ask::Reset, Ask::HoldView, Ask::Gain, Ask::Freeze,  Ask::Examine,
    Ask::Use,   Ask::Grip,  Ask::Sticks,   Ask::Law,  Ask::Limits,  Ask::Goal};

/// The word in quotes above.
const char* name(Ask ask);

/// True for what makes the vehicle stand still: anybody with the token may ask for it at any time.
bool is_stop(Ask ask);

/// One command as it was asked for. What its kind does not need is empty.
struct GroundCommand {
  Ask ask = Ask::Hover;
  std::string client;        // the name that "join" answered; empty for what anybody may ask
  std::uint64_t number = 0;  // grows with each command of the client, so that none counts twice
  std::optional<double> gain_per_s;
  std::optional<std::int64_t> frame;
  std::optional<PixelBox> box;  // whole pixels
  std::optional<double> width_m;
  std::optional<VelocityCommand> velocity;  // of the limits: all positive
  std::optional<std::string> law;
  std::optional<VehiclePlace> goal;
};

/// The longest command, bytes.
constexpr std::size_t kMaxCommandBytes = 2048;

/// The command in a JSON object {"do": word, "client": text, "number": count, ...}: velocity is
/// [forward, right, down, yaw rate] in m/s and rad/s, the goal "position_m": [forward, right, down]
/// and "yaw_rad" of a VehiclePlace. Or in one
/// sentence why there is none: too long, no JSON, an unknown key or word, a number that is missing,
/// not finite or out of range. Never throws.
std::variant<GroundCommand, std::string> parse_command(std::string_view json);

}  // namespace kestrel
