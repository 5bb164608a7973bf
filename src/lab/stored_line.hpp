#pragma once

#include <optional>
#include <string>

#include "kestrel/lab/lab_store.hpp"

namespace kestrel {

/// A line of finished.jsonl.
struct StoredLine {
  StoredRun stored;            // all but the rows of the trace
  std::size_t trace_rows = 0;  // that its trace has
};

/// Whether a line says what depends on the machine.
enum class LineTimes { Left, Kept };

/// The run as a line of JSON, without the newline.
std::string stored_line(const StoredRun& stored, LineTimes times);

/// The run of such a line; empty when it is none.
std::optional<StoredLine> read_stored_line(const std::string& line);

}  // namespace kestrel
