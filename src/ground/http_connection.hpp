#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <httplib.h>
#undef _res  // a macro of resolv.h; Eigen has a name of that kind

// One connection to the page or to the commands, with a limit to all that it may take: the
// library's own streams bound each silence, but not the whole.
namespace kestrel {

/// What a connection may take.
struct ConnectionLimits {
  double request_s = 5;  // from its start to the end of the request, TLS's handshake included
  double answer_s = 20;  // for the answer; not of a request that showed the token
  double silence_s = 2;  // in which nothing is taken or given
  std::size_t request_bytes = std::size_t{128} << 10;  // of the whole request
};

/// What became of connections, counts that several threads add to.
struct ConnectionCounts {
  std::atomic<long> slow{0};       // cut: begun and not finished in time, or an answer not taken
  std::atomic<long> crowded{0};    // cut for a newer one, having shown no token
  std::atomic<long> huge{0};       // more bytes than any request has
  std::atomic<long> malformed{0};  // no HTTP
  std::atomic<long> no_tls{0};     // no TLS where TLS is spoken
};

/// TLS for one connection; none: plain.
using Tls = std::unique_ptr<SSL, void (*)(SSL*)>;

class Connection final : public httplib::Stream {
 public:
  /// The socket stays the caller's; it is made not to block.
  Connection(socket_t socket, const ConnectionLimits& limits, Tls tls);

  /// TLS's handshake; true at once without TLS. False when there was none: told in plain words to a
  /// peer that speaks HTTP.
  bool greet();
  /// The peer has shown the token: its answer may last (a stream).
  void trust() { trusted_ = true; }
  /// Says goodbye, so that a peer can tell an end from a cut.
  void end();

  bool has_heard() const { return heard_ > 0; }
  bool was_slow() const { return slow_; }
  bool was_huge() const { return huge_; }

  bool is_readable() const override { return true; }
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool waits_for(short events);
  ssize_t receive(char* to, std::size_t size);
  bool may_go_on(ssize_t result);

  socket_t socket_;
  ConnectionLimits limits_;
  Tls tls_;
  Clock::time_point deadline_;
  std::vector<char> ahead_;  // read but not yet asked for
  std::size_t ahead_at_ = 0;
  std::size_t heard_ = 0;
  bool trusted_ = false;
  bool answering_ = false;
  bool slow_ = false;
  bool huge_ = false;
};

/// The connections that are being served. When there is no place left, the one that has been there
/// longest without showing the token gives up its own: who holds places cannot keep them, and a
/// request that is sent at once is served before it is the oldest.
class ConnectionTable {
 public:
  void enter(socket_t socket);
  void trust(socket_t socket);
  /// To be called before the socket is closed. True when it was cut by make_room.
  bool leave(socket_t socket);
  /// Cuts the oldest that nobody trusts; false: there is none.
  bool make_room();
  /// Cuts all, and all that come.
  void close();

 private:
  struct Place {
    socket_t socket;
    bool trusted = false;
    bool cut = false;
  };

  std::mutex mutex_;
  std::vector<Place> places_;  // oldest first
  bool closed_ = false;
};

}  // namespace kestrel
