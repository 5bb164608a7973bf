#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "kestrel/eval/bench_run.hpp"

namespace kestrel {

/// 16 hexadecimal digits of a text (FNV-1a, 64 bit): what changes, changes them.
std::string digest(const std::string& text);

/// The name of a file or folder for a name a human sees: spaces as commas, whatever a path or a
/// shell could take amiss as _ and then with a digest of the name behind; different names stay
/// different.
std::string file_name(const std::string& name);

/// Where finished runs are kept, a folder each: run.json (what was run, how it ended), frames.csv
/// (every answer and its error) and times.csv (processor time). Only times.csv depends on the
/// machine.
class BenchStore {
 public:
  /// Nothing is created before the first run is kept.
  explicit BenchStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Keeps a run with what its result depends on. It appears at once or, when the program is
  /// killed, not at all. Throws std::runtime_error with path, cause and remedy.
  void keep(const BenchRun& run, const TrackTruth& truth, const std::string& inputs) const;

  /// The run that was kept for this sequence and method, when it was made of the same inputs; empty
  /// when there is none, or one that cannot be read.
  std::optional<BenchRun> find(const std::string& sequence, const std::string& method,
                               const std::string& inputs) const;

  std::filesystem::path folder_of(const std::string& sequence, const std::string& method) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace kestrel
