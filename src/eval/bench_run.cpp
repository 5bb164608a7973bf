#include "kestrel/eval/bench_run.hpp"

#include <stdexcept>

namespace kestrel {
namespace {

/// The method learned nothing from the first frame.
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

BenchTracker learned(const BenchMethod& method, const cv::Mat& gray, const PixelBox& box) {
  try {
    return method.learn(gray, box);
  } catch (const std::invalid_argument& error) {
    throw Refusal(error.what());
  }
}

/// Fills run; false when it was interrupted.
bool fill(BenchRun& run, const BenchSequence& sequence, const BenchMethod& method,
          const BenchHooks& hooks) {
  const auto source = sequence.open();
  std::optional<Frame> frame = source->next();
  if (!frame) {
    const auto& why = source->skipped();
    throw std::runtime_error("it gives no frame" + (why.empty() ? "" : "; " + why.front()));
  }
  const double start_s = hooks.clock_s();
  BenchTracker tracker = learned(method, frame->gray, sequence.template_px);
  run.learn_s = hooks.clock_s() - start_s;
  for (; frame; frame = source->next()) {
    if (hooks.is_interrupted()) return false;
    const double before_s = hooks.clock_s();
    BenchAnswer answer = tracker(*frame);
    const double time_s = hooks.clock_s() - before_s;
    run.frames.push_back({frame->index, std::move(answer), time_s});
    hooks.frame_done();
  }
  run.skipped = source->skipped();
  return true;
}

}  // namespace

std::optional<BenchRun> run_bench(const BenchSequence& sequence, const BenchMethod& method,
                                  const BenchHooks& hooks) {
  BenchRun run;
  run.sequence = sequence.name;
  run.method = method.name;
  run.template_px = sequence.template_px;
  try {
    if (!fill(run, sequence, method, hooks)) return std::nullopt;
  } catch (const Refusal& refusal) {
    run.end = BenchEnd::Refused;
    run.reason = refusal.what();
  } catch (const std::exception& error) {
    run.end = BenchEnd::Failed;
    run.reason = error.what();
  }
  return run;
}

const char* name(BenchEnd end) {
  switch (end) {
    case BenchEnd::Done:
      return "done";
    case BenchEnd::Refused:
      return "refused";
    case BenchEnd::Failed:
      return "failed";
  }
  return "unknown";
}

}  // namespace kestrel
