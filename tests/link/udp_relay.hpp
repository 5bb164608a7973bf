#pragma once

#include <atomic>
#include <list>
#include <mutex>
#include <thread>

#include "link/relay.hpp"
#include "link/relay_socket.hpp"

namespace kestrel::test {

/// Carries datagrams over a bad line, on a thread of its own. Each sender has a socket of its own
/// towards `to`, which so tells them apart; up to 64 of them.
class UdpRelay {
 public:
  /// Throws std::invalid_argument for options that do not check, std::system_error when it cannot
  /// listen there.
  explicit UdpRelay(const RelayOptions& options);
  ~UdpRelay();
  UdpRelay(const UdpRelay&) = delete;
  UdpRelay& operator=(const UdpRelay&) = delete;

  /// Where it listens, with its real port.
  const Address& local() const { return local_; }

  /// The cable pulled: nothing passes either way until unblock(); what is under way still arrives.
  void block() { blocked_ = true; }
  void unblock() { blocked_ = false; }

  RelayCounts counts() const;

 private:
  struct Conversation {
    Conversation(const SystemAddress& from, const RelayOptions& options, int number);
    SystemAddress client;
    Descriptor upstream;
    ImpairedLine out;
    ImpairedLine back;
  };

  void run();
  void take_from_clients(double now_s);
  void take_from_upstream(double now_s);
  void deliver(double now_s);
  double next_s() const;
  Conversation* conversation(const SystemAddress& from);

  RelayOptions options_;
  Descriptor socket_;
  Address local_;
  std::list<Conversation> conversations_;
  long thrown_away_ = 0;
  mutable std::mutex mutex_;  // of the two above
  std::atomic<bool> blocked_ = false;
  std::atomic<bool> done_ = false;
  Descriptor wake_;
  std::thread thread_;
};

}  // namespace kestrel::test
