#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "kestrel/ground/access_token.hpp"
#include "kestrel/ground/ground_station.hpp"
#include "kestrel/ground/latest_value.hpp"
#include "kestrel/link/token_bucket.hpp"

#include "guarded_server.hpp"

// The servers behind GroundStation.
namespace kestrel {

/// Counts that several threads add to.
struct RefusalCounts {
  std::atomic<long> wrong_token{0};
  std::atomic<long> foreign{0};
  std::atomic<long> malformed{0};
  std::atomic<long> too_many{0};
  std::atomic<long> stale{0};
  std::atomic<long> no_place{0};
  std::atomic<long> view_only{0};
  ConnectionCounts connections;
};

/// As they stand.
GroundRefusals counted(const RefusalCounts& counts);

/// A server and the thread it listens in. Stops and joins where it ends.
class HttpServer {
 public:
  HttpServer(GuardedOptions options, ConnectionCounts& counts);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  httplib::Server& routes() { return server_; }

  /// Listens when this returns, and answers its port. Throws std::runtime_error when it cannot.
  std::uint16_t listen(const std::string& host, std::uint16_t port);
  void stop();

 private:
  GuardedServer server_;
  std::thread thread_;
};

/// Encoded frames of the newest view: words and picture.
using EncodedFrames = LatestValue<std::string>;

/// What both servers look at.
struct Shared {
  const GroundOptions options;
  const AccessToken token;
  const GroundStation::Clock now_s;
  const Facts facts;
  GroundDesk desk;
  RefusalCounts refusals;
  EncodedFrames frames;
  std::atomic<int> viewers{0};
  std::atomic<std::uint16_t> page_port{0};
  std::atomic<std::uint16_t> command_port{0};
  std::atomic<std::uint16_t> stop_port{0};
  const int recorded_runs = 0;  // shown instead of a flight
};

/// Answers 421 to a host that is no number and 401 without the token; true when neither was.
bool lets_in(Shared& shared, const httplib::Request& request, httplib::Response& response);

/// "http" or "https".
const char* scheme(const Shared& shared);

/// What both servers are made of: so many connections at a time, and who is trusted.
GuardedOptions guarded(Shared& shared, std::size_t threads);

/// Counts what is asked for and is not there.
void count_refusals(httplib::Server& server, Shared& shared);

/// Answers with one sentence in JSON: {"words": ...}.
void say(httplib::Response& response, int status, const std::string& words);

/// The page's address, with the token.
std::string address_of(const Shared& shared);

/// Page, style and script, and /status.
void serve_files(httplib::Server& server, Shared& shared);

/// Those, and streams.
void serve_page(httplib::Server& server, Shared& shared);

/// Commands.
void serve_commands(httplib::Server& server, Shared& shared);

/// The emergency stop: POST /stop with the token, at any rate, and nothing else.
void serve_stops(httplib::Server& server, Shared& shared);

/// How the desk stands, JSON: mode, commander, asker, gain_per_s, most_gain_per_s, speed,
/// most_speed, law, laws, sent (commands, zeros, failures), facts (name, words and "warn" or ""),
/// events, way (words, is_own, stopped), viewers, refused, refusals (each of GroundRefusals),
/// view_only.
std::string desk_json(const Shared& shared);

}  // namespace kestrel
