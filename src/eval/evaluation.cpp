#include "kestrel/eval/evaluation.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "kestrel/eval/bench_store.hpp"
#include "kestrel/io/csv.hpp"

namespace kestrel {
namespace {

/// Labels and rectangle as text: what a run depends on and the plan knows itself.
std::string text_of(const BenchSequence& sequence) {
  const PixelBox& box = sequence.template_px;
  std::string text;
  for (const double value : {box.u, box.v, box.width, box.height}) text += number(value) + ' ';
  for (const auto& [frame, corners] : sequence.truth) {
    text += '\n' + std::to_string(frame);
    for (const Pixel& p : corners) text += ' ' + number(p.u) + ' ' + number(p.v);
  }
  return text;
}

/// The runs of a plan while threads work on them.
class Work {
 public:
  Work(const EvaluationPlan& plan, const EvaluationOptions& options, const EvaluationHooks& hooks)
      : plan_(plan),
        hooks_(hooks),
        store_(options.folder / "runs"),
        done_(plan.sequences.size() * plan.methods.size()) {
    progress_.runs = done_.size();
    if (options.earlier == Earlier::Used) take_earlier();
  }

  /// Runs one after the other until none is left; called by every thread.
  void work() noexcept {
    try {
      for (std::size_t i = next_++; i < done_.size() && !is_stopped(); i = next_++) {
        if (!done_[i]) run(i);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!broken_) broken_ = std::current_exception();
      stop_ = true;
    }
  }

  /// What was finished. Throws what broke a thread.
  Evaluation result() {
    if (broken_) std::rethrow_exception(broken_);
    Evaluation evaluation;
    evaluation.planned = done_.size();
    evaluation.reused = progress_.reused;
    for (std::optional<BenchRun>& run : done_) {
      if (run) evaluation.runs.push_back(std::move(*run));
    }
    return evaluation;
  }

 private:
  const BenchSequence& sequence(std::size_t i) const {
    return plan_.sequences[i / plan_.methods.size()];
  }
  const BenchMethod& method(std::size_t i) const { return plan_.methods[i % plan_.methods.size()]; }
  bool is_stopped() const { return stop_ || hooks_.is_interrupted(); }

  std::string inputs(std::size_t i) const {
    std::string text = text_of(sequence(i));
    for (const std::string& name : {std::string(), sequence(i).name, method(i).name}) {
      const auto known = plan_.inputs.find(name);
      text += '\n' + (known == plan_.inputs.end() ? "" : known->second);
    }
    return text;
  }

  void take_earlier() {
    for (std::size_t i = 0; i < done_.size(); ++i) {
      done_[i] = store_.find(sequence(i).name, method(i).name, inputs(i));
      if (!done_[i]) continue;
      ++progress_.finished;
      ++progress_.reused;
    }
  }

  void run(std::size_t i) {
    const BenchHooks hooks{hooks_.thread_clock_s, [this] { return is_stopped(); },
                           [this] { tell_frame(); }};
    std::optional<BenchRun> run = run_bench(sequence(i), method(i), hooks);
    if (!run) return;
    if (run->end != BenchEnd::Failed) store_.keep(*run, sequence(i).truth, inputs(i));
    const std::lock_guard<std::mutex> lock(mutex_);
    done_[i] = std::move(run);
    ++progress_.finished;
    progress_.run = &*done_[i];
    hooks_.tell(progress_);
    progress_.run = nullptr;
  }

  void tell_frame() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++progress_.frames;
    hooks_.tell(progress_);
  }

  const EvaluationPlan& plan_;
  const EvaluationHooks& hooks_;
  BenchStore store_;
  std::vector<std::optional<BenchRun>> done_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;  // of all below
  EvaluationProgress progress_;
  std::exception_ptr broken_;
};

template <class Named>
void require_names(const std::vector<Named>& list, const std::string& what) {
  if (list.empty()) throw std::invalid_argument("there is no " + what + " to run; name one");
  std::set<std::string> names;
  for (const Named& one : list) {
    if (!names.insert(one.name).second) {
      throw std::invalid_argument("two of the " + what + "s are called " + one.name +
                                  "; give each once");
    }
  }
}

}  // namespace

void EvaluationPlan::check() const {
  require_names(sequences, "sequence");
  require_names(methods, "method");
}

Evaluation evaluate(const EvaluationPlan& plan, const EvaluationOptions& options,
                    const EvaluationHooks& hooks) {
  plan.check();
  if (options.jobs < 1) throw std::invalid_argument("jobs: must be 1 or more");
  Work work(plan, options, hooks);
  const auto count =
      std::min(std::size_t(options.jobs), plan.sequences.size() * plan.methods.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back([&work] { work.work(); });
  for (std::thread& thread : threads) thread.join();
  return work.result();
}

}  // namespace kestrel
