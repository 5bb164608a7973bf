#include "kestrel/ground/command_post.hpp"

namespace kestrel {

std::string CommandPost::join(double now_s) {
  if (clients_.size() >= kMaxClients) forget_one();
  std::string client = run_ + '-' + std::to_string(++joined_);
  clients_[client].heard_s = now_s;
  return client;
}

void CommandPost::forget_one() {
  auto oldest = clients_.end();
  for (auto it = clients_.begin(); it != clients_.end(); ++it) {
    if (it->first == commander_) continue;
    if (oldest == clients_.end() || it->second.heard_s < oldest->second.heard_s) oldest = it;
  }
  if (oldest->first == asker_) asker_.clear();
  clients_.erase(oldest);
}

std::optional<Answer> CommandPost::admit(const GroundCommand& command, double now_s) {
  const auto client = clients_.find(command.client);
  if (client == clients_.end()) {
    return Answer{Answer::Kind::Stranger, "this page is not known (any more): reload it"};
  }
  if (command.number <= client->second.last_number) {
    return Answer{Answer::Kind::Stale, "this command has been given before"};
  }
  client->second = {command.number, now_s};
  return std::nullopt;
}

void CommandPost::hand_to(const std::string& client) {
  commander_ = client;
  asker_.clear();
}

Answer CommandPost::take(const std::string& client, double now_s) {
  if (commands(client)) return {Answer::Kind::Done, "you have the command already"};
  const bool waited = asker_ == client && now_s - asked_s_ >= kPatience_s;
  if (commander_.empty() || waited) {
    hand_to(client);
    return {Answer::Kind::Done, "you have the command"};
  }
  if (asker_ != client) asked_s_ = now_s;
  asker_ = client;
  return {
      Answer::Kind::Refused,
      "another page has the command and is asked for it; without an answer it is yours in 10 s: "
      "take it again then"};
}

Answer CommandPost::release(const std::string& client) {
  if (!commands(client)) return {Answer::Kind::Refused, "you do not have the command"};
  hand_to(std::string(asker_));
  return {Answer::Kind::Done, commander_.empty() ? "nobody has the command now"
                                                 : "the page that asked has the command"};
}

bool CommandPost::relieve(double now_s) {
  const auto it = clients_.find(commander_);
  if (it == clients_.end() || now_s - it->second.heard_s <= kSilence_s) return false;
  hand_to(std::string());
  return true;
}

}  // namespace kestrel
