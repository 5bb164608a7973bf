#include "kestrel/link/arbiter.hpp"

#include <algorithm>

namespace kestrel {

Arbiter::Arbiter(double dead_after_s) : dead_after_s_(dead_after_s) {}

void Arbiter::heartbeat(const Claimant& source, double now_s) {
  Source* const from = known(source, now_s);
  if (from == nullptr) return;
  from->heartbeat_s = now_s;
  from->dead = from->told_dead = false;
}

std::optional<Refused> Arbiter::offer(const Claimant& source, double fresh_until_s, double now_s) {
  update(now_s);
  Source* const from = known(source, now_s);
  if (from == nullptr) return Refused::TooManySources;
  if (from->dead) return Refused::Dead;
  from->fresh_until_s = fresh_until_s;
  const auto reason = refused(*from);
  if (!reason && (!owner_ || owner_->id != source.id)) own(from->who);
  return reason;
}

std::optional<Refused> Arbiter::refused(const Source& source) const {
  if (stopped_) return Refused::Stopped;
  if (taken_over_ && source.who.role != LinkRole::Ground) return Refused::Locked;
  if (owner_ && owner_->id == source.who.id) return std::nullopt;
  if (locked_) return Refused::Locked;
  if (owner_ && source.who.priority <= owner_->priority) return Refused::NotOwner;
  return std::nullopt;
}

void Arbiter::update(double now_s) {
  for (Source& each : sources_) each.dead = now_s - each.heartbeat_s > dead_after_s_;
  if (!owner_ || locked_ || stopped_) return;
  const Source* const owner = find(owner_->id);
  if (owner == nullptr || !is_candidate(*owner, now_s)) hand_over(now_s);
}

bool Arbiter::is_candidate(const Source& source, double now_s) const {
  return !source.dead && now_s < source.fresh_until_s &&
         (!taken_over_ || source.who.role == LinkRole::Ground);
}

void Arbiter::hand_over(double now_s) {
  const Source* best = nullptr;
  for (const Source& each : sources_) {
    if (!is_candidate(each, now_s)) continue;
    if (best == nullptr || each.who.priority > best->who.priority) best = &each;
  }
  own(best != nullptr ? std::optional(best->who) : std::nullopt);
}

void Arbiter::own(const std::optional<Claimant>& owner) {
  owner_ = owner;
  had_owner_ = had_owner_ || owner.has_value();
}

void Arbiter::forget(PeerId peer, double now_s) {
  sources_.erase(std::remove_if(sources_.begin(), sources_.end(),
                                [&](const Source& each) { return each.who.id.peer == peer; }),
                 sources_.end());
  if (owner_ && owner_->id.peer == peer && !locked_ && !stopped_) hand_over(now_s);
}

void Arbiter::take_over() {
  taken_over_ = true;
  locked_ = false;
  had_owner_ = true;
  if (owner_ && owner_->role != LinkRole::Ground) owner_.reset();
}

bool Arbiter::lock() {
  if (!owner_ || taken_over_ || stopped_) return false;
  locked_ = true;
  return true;
}

void Arbiter::release() {
  taken_over_ = locked_ = false;
  owner_.reset();
}

void Arbiter::reset() {
  stopped_ = locked_ = false;
  owner_.reset();
}

ControlState Arbiter::state() const {
  if (stopped_) return ControlState::Stopped;
  if (taken_over_) return ControlState::TakenOver;
  if (locked_) return ControlState::Locked;
  if (owner_) return ControlState::Owned;
  return had_owner_ ? ControlState::Hold : ControlState::Idle;
}

std::optional<SourceId> Arbiter::owner() const {
  return owner_ && !stopped_ ? std::optional(owner_->id) : std::nullopt;
}

bool Arbiter::may_command(const SourceId& source, LinkRole role) const {
  if (stopped_ || (taken_over_ && role != LinkRole::Ground)) return false;
  return !owner_ || owner_->id == source;
}

std::vector<SourceId> Arbiter::take_dead() {
  std::vector<SourceId> dead;
  for (Source& each : sources_) {
    if (!each.dead || each.told_dead) continue;
    each.told_dead = true;
    dead.push_back(each.who.id);
  }
  return dead;
}

Arbiter::Source* Arbiter::find(const SourceId& id) {
  const auto found = std::find_if(sources_.begin(), sources_.end(),
                                  [&](const Source& each) { return each.who.id == id; });
  return found == sources_.end() ? nullptr : &*found;
}

Arbiter::Source* Arbiter::known(const Claimant& source, double now_s) {
  if (Source* const found = find(source.id)) return found;
  const auto is_of_peer = [&](const Source& each) { return each.who.id.peer == source.id.peer; };
  const auto count = [&] { return std::count_if(sources_.begin(), sources_.end(), is_of_peer); };
  if (std::size_t(count()) >= kSourcesPerPeer) make_room(source.id.peer);
  if (std::size_t(count()) >= kSourcesPerPeer) return nullptr;
  return &sources_.emplace_back(Source{source, now_s, now_s, false, false});
}

/// The peer's dead make it, but for the one that control is locked to.
void Arbiter::make_room(PeerId peer) {
  sources_.erase(std::remove_if(sources_.begin(), sources_.end(),
                                [&](const Source& each) {
                                  return each.who.id.peer == peer && each.dead &&
                                         !(owner_ && owner_->id == each.who.id);
                                }),
                 sources_.end());
}

}  // namespace kestrel
