#include "kestrel/ground/ground_command.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

namespace kestrel {
namespace {

using Json = nlohmann::json;

constexpr double kLargest = 1e6;  // px, m, 1/s, m/s, rad: none of them is larger
constexpr std::int64_t kLastNumber = std::int64_t{1} << 53;  // what a browser can count to
constexpr std::size_t kMaxWord = 64;

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument(why); }

Ask ask_of(const Json& body) {
  const auto word = body.find("do");
  if (word == body.end() || !word->is_string()) refuse("\"do\": a word is missing");
  for (const Ask ask : kAsks) {
    if (word->get_ref<const std::string&>() == name(ask)) return ask;
  }
  refuse("\"do\": there is no such command");
}

std::set<std::string> keys_of(Ask ask) {
  switch (ask) {
    case Ask::Gain:
      return {"gain_per_s"};
    case Ask::Freeze:
      return {"frame"};
    case Ask::Examine:
      return {"box"};
    case Ask::Use:
      return {"width_m"};
    case Ask::Sticks:
    case Ask::Limits:
      return {"velocity"};
    case Ask::Law:
      return {"law"};
    case Ask::Goal:
      return {"position_m", "yaw_rad"};
    default:
      return {};
  }
}

/// Nothing is missing and nothing is there that nobody would look at.
void check_keys(const Json& body, Ask ask) {
  const std::set<std::string> needed = keys_of(ask);
  for (const std::string& key : needed) {
    if (!body.contains(key)) refuse('"' + key + "\": is missing");
  }
  for (const auto& item : body.items()) {
    const bool known = item.key() == "do" || item.key() == "client" || item.key() == "number" ||
                       needed.count(item.key()) > 0;
    if (!known) refuse("a key that this command does not have");
  }
}

double number_of(const Json& value, const std::string& key) {
  if (!value.is_number()) refuse('"' + key + "\": is no number");
  const auto number = value.get<double>();
  if (!std::isfinite(number) || std::abs(number) > kLargest) {
    refuse('"' + key + "\": is out of range");
  }
  return number;
}

double positive_of(const Json& body, const std::string& key) {
  const double number = number_of(body.at(key), key);
  if (!(number > 0)) refuse('"' + key + "\": must be positive");
  return number;
}

std::int64_t count_of(const Json& value, const std::string& key) {
  const bool is_count = value.is_number_unsigned() && value.get<std::uint64_t>() <= kLastNumber;
  if (!is_count) refuse('"' + key + "\": is no count");
  return value.get<std::int64_t>();
}

template <std::size_t Count>
std::array<double, Count> numbers_of(const Json& body, const std::string& key, const char* which) {
  const Json& value = body.at(key);
  if (!value.is_array() || value.size() != Count) refuse('"' + key + "\": is not " + which);
  std::array<double, Count> numbers{};
  for (std::size_t i = 0; i < Count; ++i) numbers[i] = number_of(value[i], key);
  return numbers;
}

PixelBox box_of(const Json& body) {
  const auto numbers = numbers_of<4>(body, "box", "[x, y, width, height]");
  for (const double number : numbers) {
    if (std::floor(number) != number) refuse("\"box\": is not in whole pixels");
  }
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

VelocityCommand velocity_of(const Json& body) {
  const auto v = numbers_of<4>(body, "velocity", "[forward, right, down, yaw rate]");
  return {v[0], v[1], v[2], v[3]};
}

VelocityCommand limit_of(const Json& body) {
  const VelocityCommand limit = velocity_of(body);
  if (!(limit.vector().minCoeff() > 0)) refuse("\"velocity\": must be positive");
  return limit;
}

VehiclePlace place_of(const Json& body) {
  const auto position = numbers_of<3>(body, "position_m", "[forward, right, down]");
  const double yaw_rad = number_of(body.at("yaw_rad"), "yaw_rad");
  return {{position[0], position[1], position[2]}, yaw_rad};
}

std::string word_of(const Json& value, const std::string& key) {
  if (!value.is_string()) refuse('"' + key + "\": is no text");
  auto word = value.get<std::string>();
  if (word.size() > kMaxWord) refuse('"' + key + "\": is too long");
  return word;
}

/// The command with what its kind needs besides its word.
GroundCommand with_details(GroundCommand command, const Json& body) {
  const Ask ask = command.ask;
  if (ask == Ask::Gain) command.gain_per_s = positive_of(body, "gain_per_s");
  if (ask == Ask::Use) command.width_m = positive_of(body, "width_m");
  if (ask == Ask::Freeze) command.frame = count_of(body.at("frame"), "frame");
  if (ask == Ask::Examine) command.box = box_of(body);
  if (ask == Ask::Sticks) command.velocity = velocity_of(body);
  if (ask == Ask::Limits) command.velocity = limit_of(body);
  if (ask == Ask::Law) command.law = word_of(body.at("law"), "law");
  if (ask == Ask::Goal) command.goal = place_of(body);
  return command;
}

GroundCommand command_of(const Json& body) {
  if (!body.is_object()) refuse("is no JSON object");
  GroundCommand command;
  command.ask = ask_of(body);
  check_keys(body, command.ask);
  if (const auto client = body.find("client"); client != body.end()) {
    command.client = word_of(*client, "client");
  }
  if (const auto number = body.find("number"); number != body.end()) {
    command.number = std::uint64_t(count_of(*number, "number"));
  }
  return with_details(std::move(command), body);
}

/// No value has values in values in values: what is nested deeper is an attack on the parser.
Json parsed(std::string_view text) {
  constexpr int kDeepest = 3;
  const auto not_deep = [](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest) refuse("is nested too deeply");
    return true;
  };
  return Json::parse(text.begin(), text.end(), not_deep);
}

}  // namespace

const char* name(Ask ask) {
  constexpr std::array<const char*, kAsks.size()> kWords{
      "abort", "hover",  "join",    "take", "release", "alive",  "start", "reset",  "hold_view",
      "gain",  "freeze", "examine", "use",  "grip",    "sticks", "law",   "limits", "goal"};
  return kWords[std::size_t(ask)];
}

bool is_stop(Ask ask) { return ask == Ask::Abort || ask == Ask::Hover; }

std::variant<GroundCommand, std::string> parse_command(std::string_view json) {
  if (json.size() > kMaxCommandBytes) return "the command is too long";
  try {
    return command_of(parsed(json));
  } catch (const Json::exception&) {
    return "the command is no JSON";  // not what the parser says of it: that repeats the input
  } catch (const std::invalid_argument& error) {
    return std::string("the command: ") + error.what();
  }
}

}  // namespace kestrel
