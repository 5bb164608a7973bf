#include <nlohmann/json.hpp>

#include "kestrel/ground/request_guard.hpp"

#include "http_parts.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::json;
using httplib::Request;
using httplib::Response;

int status_of(Answer::Kind kind) {
  switch (kind) {
    case Answer::Kind::Done:
      return 200;
    case Answer::Kind::Refused:
      return 409;
    case Answer::Kind::Stale:
      return 425;
    case Answer::Kind::Stranger:
      return 410;
  }
  return 500;
}

Json verdict_json(const TemplateVerdict& v) {
  return {{"grade", name(v.grade)},
          {"words", v.words},
          {"keypoints", v.keypoints},
          {"blocks", v.blocks},
          {"spread", v.spread},
          {"self_likeness", v.self_likeness},
          {"likeness_places", v.likeness_places}};
}

void answer(const Reply& reply, FlightMode mode, Response& response) {
  Json all{{"words", reply.answer.words}, {"mode", name(mode)}};
  all["done"] = reply.answer.kind == Answer::Kind::Done;
  if (!reply.client.empty()) all["client"] = reply.client;
  if (reply.verdict) all["verdict"] = verdict_json(*reply.verdict);
  if (reply.width_m) all["width_m"] = *reply.width_m;
  response.status = status_of(reply.answer.kind);
  response.set_content(all.dump(), "application/json");
}

/// The page's own origin may read the answers; for a request of another page, false.
bool admits_origin(Shared& shared, const Request& request, Response& response) {
  if (!request.has_header("Origin")) return true;  // no browser
  const std::string origin = request.get_header_value("Origin");
  if (!is_own_origin(origin, request.get_header_value("Host"), shared.page_port, scheme(shared))) {
    ++shared.refusals.foreign;
    say(response, 403, "commands are taken from the page of this program only");
    return false;
  }
  response.set_header("Access-Control-Allow-Origin", origin);
  response.set_header("Vary", "Origin");
  return true;
}

/// The commands of all pages together, stops and sticks apart, are so many a second and no more.
class CommandRate {
 public:
  explicit CommandRate(double per_s) : bucket_({per_s, 2 * per_s}) {}
  bool takes(double now_s) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return bucket_.take(now_s);
  }

 private:
  std::mutex mutex_;
  TokenBucket bucket_;
};

/// One hand holds the sticks, and tells where they are twelve times a second.
constexpr double kSticks_per_s = 25;

struct Rates {
  explicit Rates(double commands_per_s) : commands(commands_per_s) {}
  CommandRate commands;
  CommandRate sticks{kSticks_per_s};
  CommandRate& of(Ask ask) { return ask == Ask::Sticks ? sticks : commands; }
};

void take_command(Shared& shared, Rates& rates, const Request& request, Response& response) {
  if (!admits_origin(shared, request, response) || !lets_in(shared, request, response)) return;
  const auto parsed = parse_command(request.body);
  if (const auto* why = std::get_if<std::string>(&parsed)) {
    ++shared.refusals.malformed;
    return say(response, 400, *why);
  }
  if (!shared.options.view_only.empty()) {
    ++shared.refusals.view_only;
    return say(response, 409, shared.options.view_only);
  }
  const auto& command = std::get<GroundCommand>(parsed);
  const double now_s = shared.now_s();
  if (!is_stop(command.ask) && !rates.of(command.ask).takes(now_s)) {
    ++shared.refusals.too_many;
    return say(response, 429, "too many commands; wait a second");
  }
  const Reply reply = shared.desk.handle(command, now_s);
  if (reply.answer.kind == Answer::Kind::Stale) ++shared.refusals.stale;
  answer(reply, shared.desk.mode(), response);
}

/// Whatever the body says.
void take_stop(Shared& shared, const Request& request, Response& response) {
  if (!admits_origin(shared, request, response) || !lets_in(shared, request, response)) return;
  if (!shared.options.view_only.empty()) {
    ++shared.refusals.view_only;
    return say(response, 409, shared.options.view_only);
  }
  GroundCommand stop;
  stop.ask = Ask::Abort;
  const Reply reply = shared.desk.handle(stop, shared.now_s());
  answer(reply, shared.desk.mode(), response);
}

/// A browser asks first whether a page of another port may send what it wants to send (the
/// preflight of the fetch standard, "CORS").
void take_preflight(Shared& shared, const Request& request, Response& response) {
  if (!admits_origin(shared, request, response)) return;
  response.set_header("Access-Control-Allow-Methods", "POST");
  response.set_header("Access-Control-Allow-Headers", "Authorization, Content-Type");
  response.set_header("Access-Control-Max-Age", "600");
  response.status = 204;
}

}  // namespace

void serve_commands(httplib::Server& server, Shared& shared) {
  count_refusals(server, shared);
  const auto rates = std::make_shared<Rates>(shared.options.commands_per_s);
  server.set_default_headers(
      {{"X-Content-Type-Options", "nosniff"}, {"Cache-Control", "no-store"}});
  server.Options("/command", [&shared](const Request& request, Response& response) {
    take_preflight(shared, request, response);
  });
  // A browser asks for each port of a self-signed certificate whether to trust it.
  server.Get("/", [](const Request&, Response& response) {
    response.set_content("Commands come in here. Close this and reload the page.\n", "text/plain");
  });
  server.Post("/command", [&shared, rates](const Request& request, Response& response) {
    take_command(shared, *rates, request, response);
  });
}

void serve_stops(httplib::Server& server, Shared& shared) {
  count_refusals(server, shared);
  server.set_default_headers(
      {{"X-Content-Type-Options", "nosniff"}, {"Cache-Control", "no-store"}});
  server.Options("/stop", [&shared](const Request& request, Response& response) {
    take_preflight(shared, request, response);
  });
  server.Post("/stop", [&shared](const Request& request, Response& response) {
    take_stop(shared, request, response);
  });
}

}  // namespace kestrel
