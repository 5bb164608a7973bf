#pragma once

#include <atomic>
#include <list>
#include <mutex>
#include <thread>

#include "link/relay.hpp"
#include "link/relay_socket.hpp"

namespace kestrel::test {

/// Carries TCP connections over a bad line, on a thread of its own. Bytes that wait are bounded: a
/// slow reader holds up its own writer only.
class TcpRelay {
 public:
  /// Throws as UdpRelay does.
  explicit TcpRelay(const RelayOptions& options);
  ~TcpRelay();
  TcpRelay(const TcpRelay&) = delete;
  TcpRelay& operator=(const TcpRelay&) = delete;

  /// Where it listens, with its real port.
  const Address& local() const { return local_; }

  /// The cable pulled: connections stay open, and what is sent is never answered nor delivered
  /// (half open, for both ends) until unblock(); what was swallowed is gone, so that a stream goes
  /// on in the middle of something.
  void block() { blocked_ = true; }
  void unblock() { blocked_ = false; }

  /// Resets all connections at once.
  void cut() { cut_ = true; }

  RelayCounts counts() const;

 private:
  /// One direction of a connection.
  struct Half {
    Half(const ImpairmentOptions& options, const std::string& name)
        : line(options, Carriage::Stream, name) {}
    ImpairedLine line;
    std::vector<std::uint8_t> outbound;
    bool source_ended = false;
    bool told_the_end = false;
  };
  struct Connection {
    Connection(Descriptor from, const RelayOptions& options, long number);
    Descriptor client;
    Descriptor upstream;
    Half out;
    Half back;
    bool broken = false;
  };

  void run();
  void accept_all();
  void turn(Connection& c, double now_s);
  void carry(Half& half, const Descriptor& from, const Descriptor& to, Connection& c, double now_s);
  void end_all_that_are_broken();
  double next_s() const;
  std::vector<pollfd> interests() const;

  RelayOptions options_;
  Descriptor socket_;
  Address local_;
  std::list<Connection> connections_;
  RelayCounts past_;          // of connections that have ended
  mutable std::mutex mutex_;  // of the two above
  std::atomic<bool> blocked_ = false;
  std::atomic<bool> cut_ = false;
  std::atomic<bool> done_ = false;
  Descriptor wake_;
  std::thread thread_;
};

}  // namespace kestrel::test
