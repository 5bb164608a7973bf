#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "kestrel/ground/tls_identity.hpp"

#include "http_connection.hpp"

namespace kestrel {

/// Makes the thread that calls it give way to the loop's and to the commands' (Linux: each thread
/// has a niceness of its own, sched(7)).
void give_way();

/// Threads that serve connections in the order in which they come.
class Workers final : public httplib::TaskQueue {
 public:
  /// crowded: called when more connections wait than threads do; start: by each thread, first.
  Workers(std::size_t threads, std::function<void()> crowded, std::function<void()> start);
  void enqueue(std::function<void()> job) override;
  void shutdown() override;

 private:
  void work();

  std::function<void()> crowded_;
  std::function<void()> start_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  std::size_t idle_ = 0;
  bool closed_ = false;
  std::vector<std::thread> threads_;
};

/// What a server is made of.
struct GuardedOptions {
  std::size_t threads = 16;             // connections served at a time
  std::function<void()> start = [] {};  // each thread calls it first
  ConnectionLimits limits;
  std::optional<TlsIdentity> tls;  // none: plain HTTP
  /// True for a request that shows the token.
  std::function<bool(const httplib::Request&)> trusts;
};

/// The library's server with our own connections: one request each, a deadline for the whole of it,
/// TLS on the same deadline, and room for a new one when all places are held.
class GuardedServer final : public httplib::Server {
 public:
  /// The counts must outlive the server. Throws std::runtime_error when OpenSSL refuses the
  /// identity.
  GuardedServer(GuardedOptions options, ConnectionCounts& counts);

  /// Lets many wait to be accepted, where the library lets five: of a sixth that comes at once the
  /// kernel drops the first packet, and its sender tries again a second later. To be called when
  /// the port is bound.
  void widen_queue();

  /// Cuts all connections: to be called before stop().
  void cut_all() { table_.close(); }

 private:
  bool process_and_close_socket(socket_t socket) override;
  std::atomic<long>* serve(Connection& connection);
  Tls new_tls() const;

  GuardedOptions options_;
  ConnectionCounts& counts_;
  ConnectionTable table_;
  std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)> tls_;
};

}  // namespace kestrel
