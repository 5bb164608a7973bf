#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "kestrel/io/csv.hpp"
#include "kestrel/lab/lab_run.hpp"

namespace kestrel {

/// A run that was finished, and a digest of everything its result depends on.
struct StoredRun {
  std::string inputs;
  LabRun run;
};

/// Where finished runs are kept: finished.jsonl (a line a run, all but its trace and its time),
/// timing.csv (id, law_us: the only file that depends on the machine) and runs/<id>.csv (traces; a
/// run without rows has none). While runs are made, finished.part.jsonl grows by a line as soon as
/// one is finished, so that a killed program leaves whole runs; seal() brings all into order.
class LabStore {
 public:
  /// Nothing is read or created yet.
  explicit LabStore(std::filesystem::path folder);

  /// The runs kept so far, by id; lines and traces that cannot be read are passed over.
  std::map<std::string, StoredRun> load() const;

  /// Keeps a run that is storable(); from any thread. Throws std::runtime_error with path, cause
  /// and remedy.
  void keep(const StoredRun& finished);

  /// Leaves exactly these runs, in this order; their traces are there already. Throws as keep().
  void seal(const std::vector<const StoredRun*>& finished);

  /// Where the trace of a run is.
  std::filesystem::path trace_file(const std::string& id) const;

 private:
  void remove_traces_but(const std::vector<const StoredRun*>& finished) const;

  std::filesystem::path folder_;
  std::mutex mutex_;  // of the file below
  std::unique_ptr<LineFile> part_;
};

/// The run with every figure that is not finite left out: so it reads back from the store as it
/// was.
LabRun storable(LabRun run);

/// An id as a path below a folder: each of its parts between slashes made a plain file name.
std::filesystem::path path_of_id(const std::string& id);

}  // namespace kestrel
