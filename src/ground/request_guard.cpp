#include "kestrel/ground/request_guard.hpp"

#include <algorithm>
#include <string>

namespace kestrel {
namespace {

constexpr std::size_t kMaxHost = 64;

bool consists_of(std::string_view text, std::string_view letters) {
  return !text.empty() && text.find_first_not_of(letters) == std::string_view::npos;
}

/// Where the port begins (its colon), or the end.
std::size_t port_at(std::string_view host_header) {
  const std::size_t bracket = host_header.find(']');
  const std::size_t from = bracket == std::string_view::npos ? 0 : bracket;
  return std::min(host_header.find(':', from), host_header.size());
}

bool is_number(std::string_view host) {
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    return consists_of(host.substr(1, host.size() - 2), "0123456789abcdefABCDEF:.");
  }
  return consists_of(host, "0123456789.");
}

}  // namespace

std::string_view plain_host(std::string_view host_header) {
  if (host_header.size() > kMaxHost) return {};
  const std::size_t end = port_at(host_header);
  const std::string_view port = host_header.substr(end);
  if (!port.empty() && !consists_of(port.substr(1), "0123456789")) return {};
  const std::string_view host = host_header.substr(0, end);
  return host == "localhost" || is_number(host) ? host : std::string_view{};
}

bool is_own_origin(std::string_view origin, std::string_view host_header, std::uint16_t page_port,
                   std::string_view scheme) {
  const std::string_view host = plain_host(host_header);
  if (host.empty()) return false;
  const std::string without_port = std::string(scheme) + "://" + std::string(host);
  // A browser leaves out the port that the scheme has anyway.
  const std::uint16_t own_port = scheme == "https" ? 443 : 80;
  return origin == without_port + ':' + std::to_string(page_port) ||
         (page_port == own_port && origin == without_port);
}

bool is_loopback(std::string_view host) {
  if (host == "localhost" || host == "::1") return true;
  // A name could begin like a number: 127.evil.example.
  return host.substr(0, 4) == "127." && consists_of(host, "0123456789.");
}

}  // namespace kestrel
