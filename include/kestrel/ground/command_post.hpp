#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "kestrel/ground/ground_command.hpp"

namespace kestrel {

/// What became of a command.
struct Answer {
  enum class Kind {
    Done,
    Refused,   // understood, but not now; `words` say why
    Stale,     // its number has been used: a replay, or a doubled request
    Stranger,  // its client is not known (any more): join again
  };
  Kind kind = Kind::Done;
  std::string words;  // for a human
};

/// Who may command: many look on, one commands at a time. Pure but for its own memory; times are of
/// one clock of the caller's, s.
class CommandPost {
 public:
  static constexpr std::size_t kMaxClients = 64;
  /// A commander not heard of for this long has none: its page says "alive" twice a second.
  static constexpr double kSilence_s = 2.5;
  /// Who asked for command gets it when the commander has not answered for so long.
  static constexpr double kPatience_s = 10;

  /// run: a word that no other run of the program has, so that no command of that run is one here.
  explicit CommandPost(std::string run) : run_(std::move(run)) {}

  /// A new client's name. Of more than kMaxClients the one heard of least recently is forgotten;
  /// the commander never is.
  std::string join(double now_s);

  /// Refuses a command whose client is not known or whose number is not above all before it; else
  /// the client counts as heard of. Not for stops: those need no client.
  std::optional<Answer> admit(const GroundCommand& command, double now_s);

  Answer take(const std::string& client, double now_s);
  Answer release(const std::string& client);
  bool commands(const std::string& client) const { return commander_ == client && !client.empty(); }

  /// The commander is relieved when it has been silent for too long; true when it just was.
  bool relieve(double now_s);

  /// Empty: nobody.
  const std::string& commander() const { return commander_; }
  /// Who waits for the command; empty: nobody.
  const std::string& asker() const { return asker_; }

 private:
  struct Client {
    std::uint64_t last_number = 0;
    double heard_s = 0;
  };

  void forget_one();
  void hand_to(const std::string& client);

  std::string run_;
  std::uint64_t joined_ = 0;
  std::map<std::string, Client> clients_;
  std::string commander_;
  std::string asker_;
  double asked_s_ = 0;
};

}  // namespace kestrel
