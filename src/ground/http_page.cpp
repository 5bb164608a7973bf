#include <nlohmann/json.hpp>

#include "kestrel/ground/request_guard.hpp"
#include "kestrel/ground/stream_frame.hpp"

#include "http_parts.hpp"
#include "page_parts.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::json;
using httplib::Request;
using httplib::Response;

/// Nothing from elsewhere, nothing inline, nothing but the stream and the commands to talk to.
std::string content_policy(const Shared& shared, std::string_view host) {
  return "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
         "connect-src 'self' " +
         std::string(scheme(shared)) + "://" + std::string(host) + ':' +
         std::to_string(shared.command_port) + ' ' + scheme(shared) + "://" + std::string(host) +
         ':' + std::to_string(shared.stop_port) +
         "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

void put(std::string& html, std::string_view place, int number) {
  html.replace(html.find(place), place.size(), std::to_string(number));
}

std::string filled_html(const Shared& shared) {
  std::string html(ground_html());
  put(html, "{{COMMAND_PORT}}", shared.command_port);
  put(html, "{{STOP_PORT}}", shared.stop_port);
  put(html, "{{RECORDED_RUNS}}", shared.recorded_runs);
  return html;
}

void give_html(Shared& shared, const Request& request, Response& response) {
  const std::string header = request.get_header_value("Host");
  const std::string_view host = plain_host(header);
  if (host.empty()) {
    ++shared.refusals.foreign;
    return say(response, 421, "call this machine by its number or localhost, not by another name");
  }
  response.set_header("Content-Security-Policy", content_policy(shared, host));
  response.set_content(filled_html(shared), "text/html; charset=utf-8");
}

Json velocities(const VelocityCommand& v) {
  return {v.forward_m_s, v.right_m_s, v.down_m_s, v.yaw_rate_rad_s};
}

/// A place among the viewers, given back where it ends.
class Seat {
 public:
  explicit Seat(Shared& shared) : shared_(shared) {
    has_ = ++shared_.viewers <= shared_.options.max_streams;
  }
  ~Seat() { --shared_.viewers; }
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;
  bool has() const { return has_; }

 private:
  Shared& shared_;
  bool has_ = false;
};

/// Sends the newest frame that was not sent yet; when none comes for a second, how things stand, so
/// that the page knows the line from the camera. False when the stream is over.
bool send_next(Shared& shared, std::uint64_t& known, httplib::DataSink& sink) {
  constexpr double kLongest_s = 1;
  const auto frame = shared.frames.newer_than(known, kLongest_s);
  if (shared.frames.is_closed()) return false;
  if (!frame.value) {
    const std::string words = stream_frame("{\"desk\":" + desk_json(shared) + "}", {});
    return sink.write(words.data(), words.size());
  }
  known = frame.number;
  return sink.write(frame.value->data(), frame.value->size());
}

void give_stream(Shared& shared, const Request& request, Response& response) {
  if (!lets_in(shared, request, response)) return;
  const auto seat = std::make_shared<Seat>(shared);
  if (!seat->has()) {
    ++shared.refusals.too_many;
    return say(response, 503, "too many viewers; close another page");
  }
  // What was encoded for the last viewer may be minutes old: this one begins with the next frame.
  const auto known = std::make_shared<std::uint64_t>(shared.frames.now().number);
  response.set_chunked_content_provider(
      "application/octet-stream", [&shared, seat, known](std::size_t, httplib::DataSink& sink) {
        return send_next(shared, *known, sink);
      });
}

}  // namespace

std::string desk_json(const Shared& shared) {
  const DeskStatus s = shared.desk.status();
  Json facts = Json::array();
  if (shared.facts) {
    for (const Fact& fact : shared.facts()) {
      facts.push_back({fact.name, fact.words, fact.tone == Fact::Tone::Warning ? "warn" : ""});
    }
  }
  Json events = Json::array();
  for (const GroundEvent& e : s.events) {
    events.push_back({{"number", e.number}, {"stamp_s", e.stamp_s}, {"words", e.words}});
  }
  long refused = 0;
  Json refusals;
  for (const auto& [word, count] : named(counted(shared.refusals))) {
    refused += count;
    refusals[word] = count;
  }
  return Json{
      {"mode", name(s.mode)},
      {"commander", s.commander},
      {"asker", s.asker},
      {"gain_per_s", s.gain_per_s},
      {"most_gain_per_s", s.most_gain_per_s},
      {"speed", velocities(s.limits.speed)},
      {"most_speed", velocities(s.most_speed)},
      {"law", s.law},
      {"laws", s.laws},
      {"sent", {s.sent.commands, s.sent.zeros, s.failures}},
      {"facts", facts},
      {"events", events},
      {"way", {{"words", s.way.words}, {"is_own", s.way.is_own}, {"stopped", s.way.stopped}}},
      {"viewers", shared.viewers.load()},
      {"refused", refused},
      {"refusals", refusals},
      {"view_only", shared.options.view_only}}
      .dump();
}

void serve_files(httplib::Server& server, Shared& shared) {
  count_refusals(server, shared);
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cache-Control", "no-store"},
                              {"Cross-Origin-Resource-Policy", "same-origin"}});
  server.Get("/", [&shared](const Request& request, Response& response) {
    give_html(shared, request, response);
  });
  server.Get("/ground.css", [](const Request&, Response& response) {
    response.set_content(std::string(ground_css()), "text/css; charset=utf-8");
  });
  server.Get("/ground.js", [](const Request&, Response& response) {
    response.set_content(std::string(ground_script()), "text/javascript; charset=utf-8");
  });
  server.Get("/status", [&shared](const Request& request, Response& response) {
    if (lets_in(shared, request, response)) {
      response.set_content(desk_json(shared), "application/json");
    }
  });
}

void serve_page(httplib::Server& server, Shared& shared) {
  serve_files(server, shared);
  server.Get("/stream", [&shared](const Request& request, Response& response) {
    give_stream(shared, request, response);
  });
}

}  // namespace kestrel
