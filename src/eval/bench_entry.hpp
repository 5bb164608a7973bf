#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "kestrel/eval/spread.hpp"
#include "kestrel/eval/table.hpp"

namespace kestrel {

/// A number that is missing.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kMilli = 1e-3;

/// A column and how a score fills it.
template <class Score>
struct Entry {
  Column column;
  std::function<SummaryValue(const Score&)> value;
};

/// The table of these columns, a row for each score.
template <class Score>
Table table_of(const std::vector<Entry<Score>>& entries, const std::vector<Score>& scores) {
  Table table;
  for (const Entry<Score>& entry : entries) table.columns.push_back(entry.column);
  for (const Score& score : scores) {
    auto& row = table.rows.emplace_back();
    for (const Entry<Score>& entry : entries) row.push_back(entry.value(score));
  }
  return table;
}

/// A time over the frames, ms.
template <class Score>
Entry<Score> time_entry(const std::string& name, double Spread::*value) {
  return {{name + "_ms", 2}, [value](const Score& s) -> SummaryValue {
            return s.time_s ? (*s.time_s).*value / kMilli : kNone;
          }};
}

}  // namespace kestrel
