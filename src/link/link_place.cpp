#include "kestrel/link/link_place.hpp"

#include <array>
#include <stdexcept>

namespace kestrel {
namespace {

constexpr std::string_view kSeparator = "://";

/// In the order of LinkKind.
constexpr std::array<std::string_view, 4> kSchemes = {"udp", "udp-listen", "tcp", "tcp-listen"};

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  throw std::invalid_argument("url '" + std::string(text) + "': " + why);
}

LinkKind kind_of(std::string_view text, std::string_view scheme) {
  for (std::size_t i = 0; i < kSchemes.size(); ++i) {
    if (scheme == kSchemes[i]) return LinkKind(i);
  }
  refuse(text, "write udp://, udp-listen://, tcp:// or tcp-listen:// and then HOST:PORT");
}

}  // namespace

LinkPlace parse_link_place(std::string_view text) {
  const std::size_t end = text.find(kSeparator);
  if (end == std::string_view::npos) kind_of(text, "");  // throws
  LinkPlace place;
  place.kind = kind_of(text, text.substr(0, end));
  // The rest is written as every address is.
  place.address = parse_address("udp" + std::string(text.substr(end)));
  if (!is_server(place.kind) && (place.address.port == 0 || place.address.is_any())) {
    refuse(text, "nothing can be sent there; give the other end's host and port");
  }
  return place;
}

std::string to_string(const LinkPlace& place) {
  const std::string address = to_string(place.address);
  return std::string(kSchemes[std::size_t(place.kind)]) + address.substr(address.find(kSeparator));
}

}  // namespace kestrel
