#pragma once

#include <cstdint>
#include <string_view>

namespace kestrel {

// What a request's headers say of where it comes from. A browser sends them truly; what is no
// browser has the token or has nothing.

/// The host of a header Host ("127.0.0.1:8080", "[::1]:8080", "localhost:8080"), brackets kept;
/// empty when it is no number and not localhost: a name could be made to mean this machine by
/// whoever runs its name server (DNS rebinding), a number cannot.
std::string_view plain_host(std::string_view host_header);

/// True when a request was made by the page that this program serves: the header Origin (RFC 6454)
/// is the scheme ("http" or "https"), "://", the host of the header Host, and the page's port.
/// False for none.
bool is_own_origin(std::string_view origin, std::string_view host_header, std::uint16_t page_port,
                   std::string_view scheme = "http");

/// True for a host that only this machine reaches: 127.x.x.x, ::1, localhost (RFC 5735, RFC 4291).
bool is_loopback(std::string_view host);

}  // namespace kestrel
