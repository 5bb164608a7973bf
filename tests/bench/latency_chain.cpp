#include "latency_chain.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "kestrel/io/sequence.hpp"
#include "kestrel/loop/step.hpp"

#include "stamped_picture.hpp"

namespace kestrel {
namespace {

Task task() {
  CameraParameters p;
  p.px = p.py = 300;
  p.u0 = 159.5;
  p.v0 = 119.5;
  p.width = kSize.width;
  p.height = kSize.height;
  Mount mount;
  mount.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  TargetPose goal;
  goal.translation = {0, 0, 2};
  return {Camera(p), mount, 0.4, 0.4, goal, {}, {}, {}, {}, {}};
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? -1 : values[std::size_t(share * double(values.size() - 1))];
}

void report(const char* what, const std::vector<double>& ms) {
  std::printf("  %-34s median %6.1f ms, 95 %% %6.1f ms\n", what, quantile(ms, 0.5),
              quantile(ms, 0.95));
}

}  // namespace

void measure_file(const std::string& name, const std::string& input) {
  SequenceOptions options;
  options.input = input;
  const auto source = open_sequence(options);
  const Task wanted = task();
  std::optional<Frame> frame = source->next();
  Tracker tracker(frame->gray, {100, 80, 120, 120}, wanted.track);
  LoopState state = start(tracker, *frame);
  std::vector<double> in_hand;
  std::vector<double> command;
  while (true) {
    const double asked_s = monotonic_clock_s();
    frame = source->next();
    if (!frame) break;
    in_hand.push_back(1e3 * (monotonic_clock_s() - asked_s));
    state = step(tracker, *frame, state, wanted).next;
    command.push_back(1e3 * (monotonic_clock_s() - asked_s));
  }
  std::printf("%s (%d pictures)\n", name.c_str(), int(command.size()));
  report("asked for to frame in the loop", in_hand);
  report("asked for to command", command);
}

void measure(const std::string& name, LiveSource& source,
             const std::function<double(const Frame&, double)>& age) {
  const Task wanted = task();
  std::optional<Frame> frame = source.next();
  Tracker tracker(frame->gray, {100, 80, 120, 120}, wanted.track);
  LoopState state = start(tracker, *frame);
  std::vector<double> in_hand;
  std::vector<double> stamp;
  std::vector<double> command;
  while (int(command.size()) < kPictures) {
    frame = source.next();
    if (!has_image(*frame)) continue;
    const double taken_s = monotonic_clock_s();
    in_hand.push_back(age(*frame, taken_s));
    stamp.push_back(1e3 * (taken_s - source.stamp_origin_s() - frame->stamp_s));
    Step now = step(tracker, *frame, state, wanted);
    state = now.next;
    command.push_back(age(*frame, monotonic_clock_s()));
  }
  const LiveStatus status = source.status();
  std::printf("%s (%d pictures, %d not taken in time, stamped by the %s)\n", name.c_str(),
              kPictures, int(status.dropped), kestrel::name(status.clock));
  report("drawn to frame in the loop", in_hand);
  report("of that, known by its stamp", stamp);
  report("drawn to command", command);
}

}  // namespace kestrel
