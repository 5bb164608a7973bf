#include "kestrel/lab/lab_runner.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "kestrel/eval/bench_store.hpp"
#include "kestrel/lab/lab_store.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

/// Part of the inputs: another layout of the files is another result.
constexpr const char* kFormat = "kestrel lab 1\n";

std::string inputs_digest(const LabJob& job) { return digest(kFormat + job.inputs); }

void require_unique(const std::vector<LabJob>& jobs) {
  std::set<std::string> ids;
  for (const LabJob& job : jobs) {
    if (!ids.insert(job.id).second) {
      throw std::invalid_argument("two runs are called " + job.id + "; name one otherwise");
    }
  }
}

/// The jobs while threads work on them.
class Work {
 public:
  Work(const std::vector<LabJob>& jobs, const LabRunnerOptions& options, const LabHooks& hooks)
      : jobs_(jobs),
        options_(options),
        hooks_(hooks),
        store_(options.folder),
        done_(jobs.size()),
        faults_(jobs.size()) {
    for (std::size_t i = 0; i < jobs.size(); ++i) progress_.planned += options.shard.holds(i);
  }

  /// Takes what a folder holds of the jobs, those of other shards too: they are not thrown away.
  void take(const fs::path& folder) {
    auto known = LabStore(folder).load();
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const auto found = known.find(jobs_[i].id);
      if (found == known.end() || done_[i]) continue;
      if (found->second.inputs != inputs_digest(jobs_[i])) continue;
      done_[i] = std::move(found->second);
      progress_.finished += options_.shard.holds(i);
      progress_.reused += options_.shard.holds(i);
    }
  }

  /// Keeps the traces of what was taken from elsewhere.
  void keep_taken() {
    for (const auto& stored : done_) {
      if (stored) store_.keep(*stored);
    }
  }

  void seal() {
    std::vector<const StoredRun*> finished;
    for (const auto& stored : done_) {
      if (stored) finished.push_back(&*stored);
    }
    store_.seal(finished);
  }

  /// Runs one after the other until none is left; called by every thread.
  void work() noexcept {
    try {
      for (std::size_t i = next_++; i < jobs_.size() && !is_stopped(); i = next_++) {
        if (!done_[i] && options_.shard.holds(i)) run(i);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!broken_) broken_ = std::current_exception();
      stop_ = true;
    }
  }

  /// Throws what broke a thread.
  void rethrow() const {
    if (broken_) std::rethrow_exception(broken_);
  }

  LabOutcome outcome() {
    LabOutcome outcome;
    outcome.planned = progress_.planned;
    outcome.finished = progress_.finished;
    outcome.reused = progress_.reused;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      outcome.runs.push_back(done_[i] ? std::optional(std::move(done_[i]->run)) : std::nullopt);
      if (!faults_[i].empty()) outcome.failures.push_back({jobs_[i].id, faults_[i]});
    }
    return outcome;
  }

 private:
  bool is_stopped() const { return stop_ || hooks_.is_interrupted(); }

  std::optional<StoredRun> made(std::size_t i) {
    try {
      return StoredRun{inputs_digest(jobs_[i]), storable(jobs_[i].run())};
    } catch (const std::exception& error) {  // one run's mistake is no reason to lose the others
      faults_[i] = error.what();
      if (faults_[i].empty()) faults_[i] = "failed without a word";
      return std::nullopt;
    }
  }

  void run(std::size_t i) {
    std::optional<StoredRun> stored = made(i);
    if (stored) {
      stored->run.id = jobs_[i].id;
      store_.keep(*stored);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    progress_.finished += stored.has_value();
    done_[i] = std::move(stored);
    hooks_.tell(progress_);
  }

  const std::vector<LabJob>& jobs_;
  const LabRunnerOptions& options_;
  const LabHooks& hooks_;
  LabStore store_;
  std::vector<std::optional<StoredRun>> done_;  // each written by the thread that runs it
  std::vector<std::string> faults_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;  // of all below
  LabProgress progress_;
  std::exception_ptr broken_;
};

}  // namespace

void Shard::check() const {
  if (of < 1 || number < 1 || number > of) {
    throw std::invalid_argument("shard: " + std::to_string(number) + "/" + std::to_string(of) +
                                " is none; write i/n with i from 1 to n");
  }
}

LabOutcome run_jobs(const std::vector<LabJob>& jobs, const LabRunnerOptions& options,
                    const LabHooks& hooks) {
  options.shard.check();
  if (options.jobs < 1) throw std::invalid_argument("jobs: must be 1 or more");
  require_unique(jobs);
  Work work(jobs, options, hooks);
  if (options.earlier == Earlier::Used) work.take(options.folder);
  work.seal();
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < std::min(std::size_t(options.jobs), jobs.size()); ++i) {
    threads.emplace_back([&work] { work.work(); });
  }
  for (std::thread& thread : threads) thread.join();
  work.rethrow();
  work.seal();
  return work.outcome();
}

LabOutcome merge_shards(const std::vector<LabJob>& jobs, const std::vector<fs::path>& shards,
                        const fs::path& folder) {
  require_unique(jobs);
  const LabRunnerOptions options{folder, 1, {}, Earlier::Used};
  const LabHooks hooks{};
  Work work(jobs, options, hooks);
  for (const fs::path& shard : shards) work.take(shard);
  work.keep_taken();
  work.seal();
  return work.outcome();
}

}  // namespace kestrel
