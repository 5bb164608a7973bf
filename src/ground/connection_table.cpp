// Who gives up a place when all are held.
#include <algorithm>

#include "http_connection.hpp"

namespace kestrel {

void ConnectionTable::enter(socket_t socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  places_.push_back({socket});
  if (closed_) ::shutdown(socket, SHUT_RDWR);
}

void ConnectionTable::trust(socket_t socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Place& place : places_) {
    if (place.socket == socket) place.trusted = true;
  }
}

bool ConnectionTable::leave(socket_t socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto it = std::find_if(places_.begin(), places_.end(),
                               [&](const Place& place) { return place.socket == socket; });
  if (it == places_.end()) return false;
  const bool was_cut = it->cut;
  places_.erase(it);
  return was_cut;
}

bool ConnectionTable::make_room() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto it = std::find_if(places_.begin(), places_.end(),
                               [](const Place& place) { return !place.trusted && !place.cut; });
  if (it == places_.end()) return false;
  it->cut = true;
  ::shutdown(it->socket, SHUT_RDWR);
  return true;
}

void ConnectionTable::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  for (const Place& place : places_) ::shutdown(place.socket, SHUT_RDWR);
}

}  // namespace kestrel
