#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/sequence_recorder.hpp"

#include "interrupt.hpp"
#include "progress.hpp"
#include "simulated_camera.hpp"
#include "task_setup.hpp"
#include "track_job.hpp"
#include "verbs.hpp"

namespace kestrel::app {
namespace {

/// What was recorded, and how it ended.
struct Recorded {
  std::int64_t pictures = 0;
  std::int64_t missing = 0;  // between the first picture and the last
  double first_s = 0;
  double last_s = 0;
  std::string ended_by;
  bool is_broken = false;  // source or disk failed
};

std::unique_ptr<FrameSource> open_source(const RecordArguments& a) {
  TrackArguments track;
  track.input = a.source;
  const TrackJob job = track_job(track);
  if (job.live.empty()) return open_sequence(job.sequence);
  LiveOptions options;
  options.capture = a.capture;
  options.queue_pictures = a.queue;
  options.give_up_s = a.give_up_s;
  return open_camera(job.live, options);
}

/// Why no further picture is wanted; empty when one is.
std::string enough(const RecordArguments& a, const Recorded& now) {
  if (interrupted()) return "Ctrl-C";
  if (a.frames && now.pictures >= *a.frames) return fmt::format("{} pictures", *a.frames);
  if (a.duration_s && now.pictures > 0 && now.last_s - now.first_s >= *a.duration_s)
    return fmt::format("{} s", *a.duration_s);
  return "";
}

/// Writes frames until it is enough. Frames without an image are no pictures: they take no number.
class Recording {
 public:
  Recording(FrameSource& source, SequenceRecorder& recorder)
      : source_(source), recorder_(recorder), progress_(source.frame_count(), "picture") {}

  Recorded run(const RecordArguments& a) {
    try {
      while ((now_.ended_by = enough(a, now_)).empty()) {
        if (!step()) now_.ended_by = "the end of the source";
        if (!now_.ended_by.empty()) break;
      }
      recorder_.close();
    } catch (const std::exception& error) {
      now_.ended_by = error.what();
      now_.is_broken = true;
    }
    return now_;
  }

 private:
  /// False at the end of the source.
  bool step() {
    const std::optional<Frame> frame = source_.next();
    for (; told_ < source_.skipped().size(); ++told_)
      fmt::print(stderr, "{}\n", source_.skipped()[told_]);
    if (!frame) return false;
    if (!has_image(*frame)) {
      ++blind_;
      return true;
    }
    const std::int64_t number = frame->index - blind_;
    recorder_.write(number, frame->stamp_s, frame->gray);
    if (now_.pictures == 0) {
      now_.first_s = frame->stamp_s;
      first_ = number;
    }
    now_.last_s = frame->stamp_s;
    ++now_.pictures;
    now_.missing = number - first_ + 1 - now_.pictures;
    progress_.step(now_.pictures, "");
    return true;
  }

  FrameSource& source_;
  SequenceRecorder& recorder_;
  Progress progress_;
  Recorded now_;
  std::int64_t blind_ = 0;
  std::int64_t first_ = 0;
  std::size_t told_ = 0;
};

void print_summary(const Recorded& r, const SequenceRecorder& recorder, const FrameSource& source) {
  Summary summary;
  summary.begin_section("recording");
  const double duration_s = r.last_s - r.first_s;
  summary.add("pictures written", r.pictures);
  summary.add("pictures missing", r.missing);
  summary.add("duration", duration_s, "s");
  if (duration_s > 0) summary.add("rate", double(r.pictures - 1) / duration_s, "1/s");
  summary.add("ended by", r.ended_by);
  add_source(summary, source);
  fmt::print("{}\nrecording: {}\n", text_table(summary), recorder.result().string());
}

}  // namespace

int run(const RecordArguments& a) {
  const auto source = open_source(a);
  SequenceRecorder recorder(a.output, {a.source, a.roi}, a.capture.rate_hz.value_or(30));
  const Recorded recorded = Recording(*source, recorder).run(a);
  print_summary(recorded, recorder, *source);
  if (recorded.is_broken) fmt::print(stderr, "kestrel: {}\n", recorded.ended_by);
  if (recorded.is_broken || recorded.pictures == 0) return 1;
  if (recorded.missing > 0 && !a.allow_drops) {
    fmt::print(stderr,
               "kestrel: {} pictures are missing; record smaller or slower, to a faster disk, or "
               "allow it with --allow-drops\n",
               recorded.missing);
    return 1;
  }
  return interrupted() ? kInterrupted : 0;
}

}  // namespace kestrel::app
