#include "kestrel/link/address.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <tuple>

#include <arpa/inet.h>

namespace kestrel {
namespace {

constexpr std::string_view kScheme = "udp://";

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  throw std::invalid_argument("address '" + std::string(text) + "': " + why +
                              "; write udp://127.0.0.1:5005 or udp://[::1]:5005");
}

/// The host in its canonical spelling; empty when it is not a number of this family.
std::optional<std::string> canonical(const std::string& host, int family) {
  std::array<unsigned char, sizeof(in6_addr)> number{};
  std::array<char, INET6_ADDRSTRLEN> spelling{};
  if (host.find('\0') != std::string::npos) return std::nullopt;
  if (inet_pton(family, host.c_str(), number.data()) != 1) return std::nullopt;
  return std::string(inet_ntop(family, number.data(), spelling.data(), spelling.size()));
}

std::optional<std::uint16_t> parse_port(std::string_view digits) {
  std::uint16_t port = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, port);
  if (error != std::errc() || stop != end) return std::nullopt;
  return port;
}

}  // namespace

bool operator==(const Address& a, const Address& b) { return a.port == b.port && a.host == b.host; }
bool operator!=(const Address& a, const Address& b) { return !(a == b); }
bool operator<(const Address& a, const Address& b) {
  return std::tie(a.host, a.port) < std::tie(b.host, b.port);
}

Address parse_address(std::string_view text) {
  if (text.substr(0, kScheme.size()) != kScheme) refuse(text, "it does not start with udp://");
  const std::string_view place = text.substr(kScheme.size());
  const bool bracketed = place.substr(0, 1) == "[";
  const std::size_t bracket = place.find(']');
  if (bracketed && bracket == std::string_view::npos) refuse(text, "']' is missing");
  const std::size_t colon = bracketed ? bracket + 1 : place.find(':');
  if (colon >= place.size() || place[colon] != ':') refuse(text, "the port is missing");

  const std::optional<std::uint16_t> port = parse_port(place.substr(colon + 1));
  if (!bracketed && place.find(':', colon + 1) != std::string_view::npos) {
    refuse(text, "an IPv6 address needs brackets");
  }
  if (!port) refuse(text, "the port must be a number from 0 to 65535");

  std::string host(bracketed ? place.substr(1, bracket - 1) : place.substr(0, colon));
  if (host == "localhost" && !bracketed) host = "127.0.0.1";
  const std::optional<std::string> spelling = canonical(host, bracketed ? AF_INET6 : AF_INET);
  if (!spelling) {
    refuse(text, bracketed ? "'" + host + "' is not an IPv6 address"
                           : "'" + host + "' is not an IPv4 address, and names are not looked up");
  }
  return {*spelling, *port};
}

std::string to_string(const Address& address) {
  const std::string host = address.is_ipv6() ? "[" + address.host + "]" : address.host;
  return std::string(kScheme) + host + ":" + std::to_string(address.port);
}

}  // namespace kestrel
