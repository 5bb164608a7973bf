#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kestrel/io/csv.hpp"

namespace kestrel {

/// Processing times, one row a frame, ms: kept apart from the run log, which must not depend on the
/// machine.
class TimingLog {
 public:
  /// Creates the file with the columns frame and <stage>_ms. Throws as LineFile.
  TimingLog(const std::filesystem::path& path, const std::vector<std::string>& stages);

  /// Appends a row, microseconds kept; empty fields for times that are not finite. Throws
  /// std::invalid_argument unless there is one time for each stage, std::runtime_error as LineFile.
  void write(std::int64_t frame, const std::vector<double>& times_ms);

 private:
  LineFile file_;
  std::size_t stages_;
};

}  // namespace kestrel
