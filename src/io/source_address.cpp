#include "kestrel/io/source_address.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <vector>

#include "kestrel/io/text_file.hpp"

namespace kestrel {
namespace {

enum class Place {
  Needed,   // something must follow the scheme
  May,      // something may
  None,     // the scheme is the whole address
  Address,  // the scheme belongs to the place: a URL of FFmpeg
};

struct Scheme {
  const char* start;
  SourceKind kind;
  Place place;
  const char* shown;
};

/// Every scheme there is: a new source is one line here.
constexpr std::array<Scheme, 12> kSchemes = {{
    {"sequence:", SourceKind::Sequence, Place::Needed, "sequence:FILE"},
    {"images:", SourceKind::Images, Place::Needed, "images:PATTERN"},
    {"video:", SourceKind::Video, Place::Needed, "video:FILE"},
    {"camera:", SourceKind::V4l2, Place::Needed, "camera:N"},
    {"dc1394", SourceKind::Dc1394, Place::May, "dc1394:GUID (or dc1394)"},
    {"rtsp://", SourceKind::Network, Place::Address, "rtsp://..."},
    {"rtp:", SourceKind::Network, Place::Address, "rtp://... (or rtp:FILE.sdp)"},
    {"udp://", SourceKind::Network, Place::Address, "udp://..."},
    {"http://", SourceKind::Network, Place::Address, "http://..."},
    {"https://", SourceKind::Network, Place::Address, "https://..."},
    {"sim:", SourceKind::Simulated, Place::Needed, "sim:HOST:PORT (or sim:PATH)"},
    {"simulation", SourceKind::Simulation, Place::None, "simulation"},
}};

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// What follows the scheme; empty when the text is not of it.
std::optional<std::string> place_of(const Scheme& scheme, const std::string& text) {
  if (!begins_with(text, scheme.start)) return std::nullopt;
  const std::string rest = text.substr(std::string(scheme.start).size());
  switch (scheme.place) {
    case Place::Needed:
      return rest;
    case Place::None:
      return rest.empty() ? std::optional(rest) : std::nullopt;
    case Place::Address:
      return text;
    case Place::May:
      break;
  }
  if (rest.empty()) return rest;
  return rest[0] == ':' ? std::optional(rest.substr(1)) : std::nullopt;
}

std::string known_schemes() {
  std::string list;
  for (const Scheme& scheme : kSchemes)
    list += (list.empty() ? "" : ", ") + std::string(scheme.shown);
  return list;
}

/// "; did you mean camera:?", or nothing.
std::string nearest_scheme(const std::string& text) {
  std::vector<std::string> starts;
  starts.reserve(kSchemes.size());
  for (const Scheme& scheme : kSchemes) starts.emplace_back(scheme.start);
  const auto colon = text.find(':');
  const std::string word = colon == std::string::npos ? text : text.substr(0, colon + 1);
  const std::string near = nearest_word(word, starts);
  return near.empty() ? "" : "; did you mean " + near + "?";
}

}  // namespace

SourceAddress parse_source(const std::string& text) {
  for (const Scheme& scheme : kSchemes) {
    const auto place = place_of(scheme, text);
    if (!place) continue;
    const bool is_bare = place->empty() || (scheme.place == Place::Address && text == scheme.start);
    const bool needs_place = scheme.place == Place::Needed || scheme.place == Place::Address;
    if (is_bare && needs_place) {
      throw std::invalid_argument("names no file after the colon, or no camera or address; write " +
                                  std::string(scheme.shown));
    }
    return {scheme.kind, text, *place};
  }
  throw std::invalid_argument("is '" + text + "'; give one of " + known_schemes() +
                              nearest_scheme(text));
}

bool is_source_address(const std::string& text) {
  return std::any_of(kSchemes.begin(), kSchemes.end(),
                     [&](const Scheme& scheme) { return place_of(scheme, text).has_value(); });
}

bool is_live(SourceKind kind) {
  return kind == SourceKind::V4l2 || kind == SourceKind::Dc1394 || kind == SourceKind::Network ||
         kind == SourceKind::Simulated;
}

}  // namespace kestrel
