#include "kestrel/link/port_event.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace kestrel {
namespace {

void positive(const char* name, double seconds) {
  if (!(seconds > 0) || !std::isfinite(seconds)) {
    throw std::invalid_argument(std::string(name) + " must be positive");
  }
}

}  // namespace

void PortOptions::check() const {
  if (max_peers == 0 || max_peers > 64) throw std::invalid_argument("max_peers must be 1 to 64");
  positive("forget_s", forget_s);
  positive("replace_s", replace_s);
  positive("retry_s", retry_s);
  if (!(longest_retry_s >= retry_s)) {
    throw std::invalid_argument("longest_retry_s must not be below retry_s");
  }
  stream.check();
}

}  // namespace kestrel
