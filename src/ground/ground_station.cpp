#include "kestrel/ground/ground_station.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include "kestrel/ground/request_guard.hpp"
#include "kestrel/ground/stream_frame.hpp"
#include "kestrel/io/image_codec.hpp"

#include "http_parts.hpp"

namespace kestrel {
namespace {

constexpr std::size_t kPageThreads = 16;  // besides the streams
constexpr std::size_t kCommandThreads = 64;
constexpr std::size_t kStopThreads = 16;

void require(bool good, const char* what) {
  if (!good) throw std::invalid_argument(what);
}

/// A word that no other run has: a part of a token that is thrown away.
std::string word_of_this_run() { return random_token().text().substr(0, 16); }

/// How often sticks that nobody holds are looked for: the dead man is late by so much at most.
constexpr std::chrono::milliseconds kLook{20};

/// Pictures give way to the loop; commands do not.
GuardedOptions modest(GuardedOptions options) {
  options.start = give_way;
  return options;
}

/// A view and when it was shown.
struct Shown {
  std::shared_ptr<const GroundView> view;
  double now_s = 0;
};

}  // namespace

std::vector<std::pair<std::string, long>> named(const GroundRefusals& r) {
  return {{"wrong_token", r.wrong_token},
          {"foreign", r.foreign},
          {"malformed", r.malformed},
          {"too_many", r.too_many},
          {"stale", r.stale},
          {"slow", r.slow},
          {"huge", r.huge},
          {"crowded", r.crowded},
          {"no_place", r.no_place},
          {"no_tls", r.no_tls},
          {"view_only", r.view_only}};
}

void GroundOptions::check() const {
  require(tls || allows_plain || is_loopback(host),
          "host: beyond this machine whoever listens on the way reads the token: serve TLS, or "
          "allow plain HTTP");
  require(max_streams >= 1 && max_streams <= 64, "max_streams: must be 1 to 64");
  require(std::isfinite(commands_per_s) && commands_per_s >= 1,
          "commands_per_s: must be finite and 1 or more (1/s)");
  require(std::isfinite(request_s) && request_s > 0, "request_s: must be finite and positive (s)");
  require(jpeg_quality >= 1 && jpeg_quality <= 100, "jpeg_quality: must be 1 to 100");
  require(command_port == 0 || command_port != port,
          "command_port: must not be the port of the page");
  require(stop_port == 0 || (stop_port != port && stop_port != command_port),
          "stop_port: must not be the port of the page or of the commands");
}

struct GroundStation::Parts {
  Shared shared;
  LatestValue<Shown> views;
  HttpServer page;
  HttpServer commands;
  HttpServer stops;
  std::thread encoder;
  std::thread watchman;

  Parts(const GroundOptions& options, const AccessToken& token, const Task& task, CommandGate& gate,
        Clock now_s, Facts facts, OperatorLink* by_hand)
      : shared{options,
               token,
               std::move(now_s),
               std::move(facts),
               {task, gate, word_of_this_run(), by_hand},
               {},
               {},
               {0},
               {0},
               {0},
               {0}},
        page(modest(guarded(shared, kPageThreads + std::size_t(options.max_streams))),
             shared.refusals.connections),
        commands(guarded(shared, kCommandThreads), shared.refusals.connections),
        stops(guarded(shared, kStopThreads), shared.refusals.connections) {
    serve_page(page.routes(), shared);
    serve_commands(commands.routes(), shared);
    serve_stops(stops.routes(), shared);
    // The page last: one that is served can command and stop.
    const auto port_of = [&](std::uint16_t given, int behind) {
      return given == 0 && options.port != 0 ? std::uint16_t(options.port + behind) : given;
    };
    shared.stop_port = stops.listen(options.host, port_of(options.stop_port, 2));
    shared.command_port = commands.listen(options.host, port_of(options.command_port, 1));
    shared.page_port = page.listen(options.host, options.port);
    encoder = std::thread([this] { encode(); });
    watchman = std::thread([this] { watch(); });
  }

  ~Parts() {
    views.close();
    shared.frames.close();
    page.stop();
    commands.stop();
    stops.stop();
    if (encoder.joinable()) encoder.join();
    if (watchman.joinable()) watchman.join();
  }

  /// Looks after the desk; a thread of its own, since nothing that flies may wait for a picture.
  void watch() {
    while (!views.is_closed()) {
      shared.desk.look_after(shared.now_s());
      std::this_thread::sleep_for(kLook);
    }
  }

  /// Encodes the newest view for all viewers, as long as there are any.
  void encode() {
    give_way();
    constexpr double kLook_s = 0.5;
    std::uint64_t known = 0;
    while (!views.is_closed()) {
      const auto shown = views.newer_than(known, kLook_s);
      if (!shown.value) continue;
      known = shown.number;
      if (shared.viewers > 0) shared.frames.put(encoded(*shown.value));
    }
  }

  std::shared_ptr<const std::string> encoded(const Shown& shown) const {
    const GroundView& view = *shown.view;
    std::vector<unsigned char> jpeg;
    if (!view.gray.empty()) jpeg = encode_jpeg(view.gray, shared.options.jpeg_quality);
    const double behind_ms = (shared.now_s() - shown.now_s) * 1e3;
    return std::make_shared<const std::string>(
        stream_frame("{\"view\":" + json(view) + ",\"desk\":" + desk_json(shared) +
                         ",\"encode_ms\":" + std::to_string(behind_ms) + "}",
                     jpeg));
  }
};

GroundStation::GroundStation(const GroundOptions& options, const AccessToken& token,
                             const Task& task, CommandGate& gate, Clock now_s, Facts facts,
                             OperatorLink* by_hand) {
  options.check();
  parts_ = std::make_unique<Parts>(options, token, task, gate, std::move(now_s), std::move(facts),
                                   by_hand);
}

GroundStation::~GroundStation() = default;

std::uint16_t GroundStation::port() const { return parts_->shared.page_port; }
std::uint16_t GroundStation::command_port() const { return parts_->shared.command_port; }
std::uint16_t GroundStation::stop_port() const { return parts_->shared.stop_port; }
GroundDesk& GroundStation::desk() { return parts_->shared.desk; }

std::string GroundStation::address() const { return address_of(parts_->shared); }

Decision GroundStation::steered(Decision decision, const DecisionState& before) {
  return parts_->shared.desk.steered(std::move(decision), before, parts_->shared.now_s());
}

GroundRefusals GroundStation::refusals() const { return counted(parts_->shared.refusals); }

void GroundStation::show(GroundView view) {
  auto shared_view = std::make_shared<const GroundView>(std::move(view));
  parts_->shared.desk.show(shared_view);
  parts_->views.put(
      std::make_shared<const Shown>(Shown{std::move(shared_view), parts_->shared.now_s()}));
}

}  // namespace kestrel
