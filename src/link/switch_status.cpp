#include "kestrel/link/switch_status.hpp"

namespace kestrel {

bool operator==(const SourceId& a, const SourceId& b) {
  return a.peer == b.peer && a.system_id == b.system_id && a.component_id == b.component_id;
}
bool operator!=(const SourceId& a, const SourceId& b) { return !(a == b); }

const char* name(SwitchEventKind kind) {
  constexpr const char* kNames[] = {
      "connected",   "disconnected",   "refused",        "owner changed", "deadman",
      "source dead", "taken over",     "locked",         "released",      "emergency stop",
      "reset",       "control denied", "too many peers", "shutdown"};
  return kNames[std::size_t(kind)];
}

const char* name(ControlState state) {
  constexpr const char* kNames[] = {"idle", "hold", "owned", "locked", "taken over", "stopped"};
  return kNames[std::size_t(state)];
}

}  // namespace kestrel
