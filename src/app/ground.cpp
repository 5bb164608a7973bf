#include "ground.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "kestrel/link/key_file.hpp"

#include "progress.hpp"

namespace kestrel::app {
namespace {

/// What cannot be said (a full disk behind stderr) ends nothing.
void say(const std::string& words) noexcept { std::fwrite(words.data(), 1, words.size(), stderr); }

double unix_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

GroundOptions ground_options(const GroundArguments& a) {
  GroundOptions options;
  options.host = a.host;
  options.port = a.port.value_or(0);
  options.allows_plain = a.plain;
  if (!a.certificate.empty()) options.tls = load_identity(a.certificate, a.key);
  if (a.self_signed) options.tls = self_signed_identity(a.host);
  return options;
}

AccessToken ground_token(const GroundArguments& a) {
  return a.token.empty() ? random_token() : load_token(a.token);
}

void announce(const std::string& address, const GroundOptions& options, const GroundArguments& a) {
  // A token of a file is known to who may read the file, and printed nowhere.
  fmt::print(stderr, "ground station: {}\n",
             a.token.empty() ? address : address.substr(0, address.find('#')));
  if (a.self_signed) {
    fmt::print(stderr,
               "                the browser will warn: compare its SHA-256 fingerprint with\n"
               "                {}\n",
               options.tls->fingerprint());
  }
}

std::unique_ptr<OperatorLink> operator_link(const GroundArguments& a) {
  if (a.link.empty()) return nullptr;
  OperatorLinkOptions options;
  if (!a.link_key.empty()) options.key = mavlink::load_key(a.link_key);
  options.unix_s = unix_s;
  return std::make_unique<OperatorLink>(parse_address(a.link), options);
}

Ground::Ground(const GroundArguments& a, const Task& task, CommandSink& sink, Facts facts)
    : sink_(sink) {
  const bool has_keys = a.keys && TerminalKeys::is_there();
  if (!a.port && !has_keys) return;
  if (a.port) link_ = operator_link(a);
  gate_ = std::make_unique<CommandGate>(sink, link_.get());
  if (a.port) {
    serve(a, task, std::move(facts));
  } else {
    key_flight_ = std::make_unique<KeyFlight>(*gate_);
  }
  if (has_keys) listen_to_keys();
}

void Ground::serve(const GroundArguments& a, const Task& task, Facts facts) {
  const GroundOptions options = ground_options(a);
  station_ = std::make_unique<GroundStation>(options, ground_token(a), task, *gate_, monotonic_s,
                                             std::move(facts), link_.get());
  announce(station_->address(), options, a);
  fmt::print(stderr,
             "                hovers until Start is pressed there; commands at port {}, "
             "emergency stop at port {}\n",
             station_->command_port(), station_->stop_port());
  if (link_) {
    fmt::print(stderr, "                a hand flies by the ground's own link, {}\n",
               to_string(link_->to()));
  }
}

void Ground::listen_to_keys() {
  fmt::print(stderr, "{}\n", station_ ? kKeysBesidePage : kKeysAlone);
  keys_ = std::make_unique<TerminalKeys>([this](const std::string& typed) {
    std::string words;
    if (key_flight_) {
      words = key_flight_->press(typed);
    } else if (typed.find(' ') != std::string::npos) {
      GroundCommand stop;
      stop.ask = Ask::Abort;
      words = station_->desk().handle(stop, monotonic_s()).answer.words;
    }
    if (!words.empty()) say("\nterminal: " + words + "\n");
  });
}

std::function<Decision(Decision, const DecisionState&)> Ground::steering() {
  if (station_) {
    return [this](Decision decision, const DecisionState& before) {
      return station_->steered(std::move(decision), before);
    };
  }
  if (!key_flight_) return nullptr;
  return [this](Decision decision, const DecisionState&) {
    return key_flight_->steered(std::move(decision));
  };
}

Task no_task() {
  CameraParameters any;  // no picture is measured with it
  any.px = any.py = 1;
  return Task{Camera(any)};
}

OnlookerGround::OnlookerGround(const GroundArguments& a, const std::string& why) {
  if (!a.port) return;
  GroundOptions options = ground_options(a);
  options.view_only = why;
  station_ =
      std::make_unique<GroundStation>(options, ground_token(a), no_task(), gate_, monotonic_s);
  announce(station_->address(), options, a);
}

void OnlookerGround::show(const Frame& frame, const LogRow& row, const Track& track,
                          double chain_ms) {
  if (!station_) return;
  GroundView view;
  view.row = row;
  view.gray = frame.gray.clone();  // the source may use its picture again
  view.goal_corners.fill({std::nan(""), std::nan("")});
  add_matches(logged_matches(track), view);
  if (row.pose) view.seen = target_pose(*row.pose);
  view.chain_ms = chain_ms;
  station_->show(std::move(view));
}

}  // namespace kestrel::app
