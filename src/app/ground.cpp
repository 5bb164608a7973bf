#include "ground.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "progress.hpp"

namespace kestrel::app {

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

Ground::Ground(const GroundArguments& a, const Task& task, CommandSink& sink, Facts facts)
    : sink_(sink) {
  if (!a.port) return;
  const GroundOptions options = ground_options(a);
  gate_ = std::make_unique<CommandGate>(sink);
  station_ = std::make_unique<GroundStation>(options, ground_token(a), task, *gate_, monotonic_s,
                                             std::move(facts));
  announce(station_->address(), options, a);
  fmt::print(stderr, "                hovers until Start is pressed there; commands at port {}\n",
             station_->command_port());
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
