#include <cmath>
#include <stdexcept>

#include "kestrel/io/task_options.hpp"

namespace kestrel {
namespace {

CaptureSettings read_capture(const Section& s) {
  CaptureSettings c;
  c.format = s.text("format", std::string());
  if (s.has("size_px")) {
    const std::vector<double> size = s.numbers("size_px", 2);
    constexpr double kMost_px = 1e5;
    for (const double side : size) {
      if (!(side >= 1 && side <= kMost_px && side == std::floor(side)))
        s.fail("size_px", "is no image size; give [width, height] in whole pixels");
    }
    c.size = cv::Size(int(size[0]), int(size[1]));
  }
  if (s.has("rate_hz")) c.rate_hz = s.number("rate_hz");
  if (s.has("exposure_s")) c.exposure_s = s.number("exposure_s");
  if (s.has("gain")) c.gain = s.number("gain");
  if (const auto t = s.child_if("trigger")) {
    TriggerSettings trigger;
    trigger.source = t->text("source", trigger.source);
    trigger.mode = t->whole("mode", trigger.mode);
    trigger.polarity = t->text("polarity", trigger.polarity);
    c.trigger = trigger;
  }
  return c;
}

}  // namespace

LiveOptions read_live_options(const Section& root) {
  LiveOptions o;
  const auto section = root.child_if("capture");
  if (!section) return o;
  o.capture = read_capture(*section);
  o.open_timeout_s = section->number("open_timeout_s", o.open_timeout_s);
  o.stall_timeout_s = section->number("stall_timeout_s", o.stall_timeout_s);
  o.blind_s = section->number("blind_s", o.blind_s);
  o.give_up_s = section->number("give_up_s", o.give_up_s);
  o.retry_s = section->number("retry_s", o.retry_s);
  o.longest_retry_s = section->number("longest_retry_s", o.longest_retry_s);
  try {
    o.check();
  } catch (const std::invalid_argument& error) {
    section->fail("", std::string(error.what()) + "; see tasks/README.md for its range");
  }
  return o;
}

}  // namespace kestrel
