#include <chrono>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "kestrel/ground/request_guard.hpp"

#include "http_parts.hpp"

namespace kestrel {
namespace {

constexpr int kSendBuffer = 128 << 10;  // what a slow viewer is behind by, besides one frame

/// Not SO_REUSEPORT, the library's own choice: two programs would share a port in silence.
void set_socket_options(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
}

}  // namespace

HttpServer::HttpServer(GuardedOptions options, ConnectionCounts& counts)
    : server_(std::move(options), counts) {
  server_.set_socket_options(set_socket_options);
  server_.set_tcp_nodelay(true);
  server_.set_payload_max_length(kMaxCommandBytes);
}

HttpServer::~HttpServer() { stop(); }

std::uint16_t HttpServer::listen(const std::string& host, std::uint16_t port) {
  int bound = port;
  if (port == 0) {
    bound = server_.bind_to_any_port(host);
  } else if (!server_.bind_to_port(host, port)) {
    bound = -1;
  }
  if (bound <= 0) {
    throw std::runtime_error("ground station: cannot listen at " + host + " port " +
                             std::to_string(port) +
                             ": it is taken, or not of this machine; give another --ground PORT");
  }
  server_.widen_queue();
  thread_ = std::thread([this] { server_.listen_after_bind(); });
  while (!server_.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return std::uint16_t(bound);
}

void HttpServer::stop() {
  if (!thread_.joinable()) return;
  server_.cut_all();
  server_.stop();
  thread_.join();
}

const char* scheme(const Shared& shared) { return shared.options.tls ? "https" : "http"; }

std::string address_of(const Shared& shared) {
  const std::string& host = shared.options.host;
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return scheme(shared) + std::string("://") + (is_ipv6 ? '[' + host + ']' : host) + ':' +
         std::to_string(shared.page_port) + "/#token=" + shared.token.text();
}

GuardedOptions guarded(Shared& shared, std::size_t threads) {
  ConnectionLimits limits;
  limits.request_s = shared.options.request_s;
  return {threads, [] {}, limits, shared.options.tls,
          [&shared](const httplib::Request& request) {
            return shared.token.is_shown_by(request.get_header_value("Authorization"));
          }};
}

void count_refusals(httplib::Server& server, Shared& shared) {
  const httplib::Server::HandlerWithResponse count = [&shared](const httplib::Request&,
                                                               httplib::Response& response) {
    constexpr int kNotFound = 404;
    if (response.status == kNotFound) ++shared.refusals.no_place;
    return httplib::Server::HandlerResponse::Unhandled;
  };
  server.set_error_handler(count);
}

GroundRefusals counted(const RefusalCounts& r) {
  const ConnectionCounts& c = r.connections;
  return {r.wrong_token, r.foreign,  r.malformed + c.malformed,
          r.too_many,    r.stale,    c.slow,
          c.huge,        c.crowded,  r.no_place,
          c.no_tls,      r.view_only};
}

void say(httplib::Response& response, int status, const std::string& words) {
  response.status = status;
  response.set_content(nlohmann::json{{"words", words}}.dump(), "application/json");
}

bool lets_in(Shared& shared, const httplib::Request& request, httplib::Response& response) {
  if (plain_host(request.get_header_value("Host")).empty()) {
    ++shared.refusals.foreign;
    say(response, 421, "call this machine by its number or localhost, not by another name");
    return false;
  }
  if (!shared.token.is_shown_by(request.get_header_value("Authorization"))) {
    ++shared.refusals.wrong_token;
    response.set_header("WWW-Authenticate", "Bearer");
    say(response, 401, "the token is missing or wrong");
    return false;
  }
  return true;
}

}  // namespace kestrel
