#include "kestrel/io/live_source.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "live_reader.hpp"

namespace kestrel {
namespace {

constexpr double kTick_s = 0.1;          // between frames without an image
constexpr std::size_t kMostWords = 200;  // a source that fails for days must not fill the memory

LiveOptions checked(const LiveOptions& options) {
  options.check();
  return options;
}

}  // namespace

LiveSource::LiveSource(std::string address, OpenCamera open, const LiveOptions& options,
                       FirstOpening first)
    : address_(std::move(address)),
      options_(checked(options)),
      origin_s_(monotonic_clock_s()),
      reader_(std::make_unique<Reader>(address_, std::move(open), options_, first)) {}

LiveSource::~LiveSource() = default;

std::optional<Frame> LiveSource::next() {
  const double since_s = last_image_s_.value_or(monotonic_clock_s());
  const double wait_s = !last_image_s_
                            ? options_.open_timeout_s
                            : std::max(kTick_s, since_s + options_.blind_s - monotonic_clock_s());
  const double until_s = monotonic_clock_s() + wait_s;
  while (true) {
    std::optional<Picture> picture =
        reader_->queue.take(std::max(until_s - monotonic_clock_s(), 0.0));
    collect_words();
    if (!picture) break;
    // A stamp that does not increase is no capture time the loop could use: the frame counts as
    // lost.
    const bool is_newer = index_ < 0 || picture->captured_s - origin_s_ > stamp_s_;
    if (is_newer) return frame_of(std::move(*picture));
    index_ += 1 + picture->lost;
  }
  const double silent_s = monotonic_clock_s() - since_s;
  if (!last_image_s_ || silent_s > options_.give_up_s) {
    std::string trouble = reader_->status().trouble;
    if (trouble.empty() && !skipped_.empty()) trouble = skipped_.back();  // it may be open again
    throw std::runtime_error(
        fmt::format("{}: no picture for {:.3g} s; check the camera and its "
                    "connection{}",
                    address_, silent_s, trouble.empty() ? "" : " (" + trouble + ")"));
  }
  return blind_frame();
}

Frame LiveSource::frame_of(Picture picture) {
  index_ += 1 + picture.lost;
  stamp_s_ = picture.captured_s - origin_s_;
  last_image_stamp_s_ = stamp_s_;
  last_image_s_ = monotonic_clock_s();
  return {index_, stamp_s_, std::move(picture.gray), std::nullopt};
}

/// Its stamp is that of the last image and the time since it was given: pictures that are as late
/// as that one was still have newer stamps.
Frame LiveSource::blind_frame() {
  ++index_;
  stamp_s_ = std::max(stamp_s_ + 1e-6,
                      last_image_stamp_s_ + (monotonic_clock_s() - last_image_s_.value_or(0)));
  return {index_, stamp_s_, cv::Mat(), std::nullopt};
}

void LiveSource::collect_words() {
  for (std::string& words : reader_->take_words()) {
    if (skipped_.size() + 1 < kMostWords) skipped_.push_back(std::move(words));
    if (skipped_.size() + 1 == kMostWords)
      skipped_.push_back(address_ + ": what else went wrong is only counted");
  }
}

const std::vector<std::string>& LiveSource::skipped() const { return skipped_; }

double LiveSource::stamp_origin_s() const { return origin_s_; }

LiveStatus LiveSource::status() const { return reader_->status(); }

std::optional<double> stamp_origin_s(const FrameSource& source) {
  const auto* const live = dynamic_cast<const LiveSource*>(&source);
  return live != nullptr ? std::optional(live->stamp_origin_s()) : std::nullopt;
}

std::optional<LiveStatus> live_status(const FrameSource& source) {
  const auto* const live = dynamic_cast<const LiveSource*>(&source);
  return live != nullptr ? std::optional(live->status()) : std::nullopt;
}

}  // namespace kestrel
