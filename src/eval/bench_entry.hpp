#pragma once

#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
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

/// How many of the labelled frames are how near, in per cent. of(score) points to what has these
/// shares, or to nothing where there are none.
template <class Score, class Of>
std::vector<Entry<Score>> share_entries(Of of) {
  using Shares = std::decay_t<decltype(*of(std::declval<const Score&>()))>;
  const auto percent = [of](const std::string& name, double Shares::*share) -> Entry<Score> {
    return {{name + "_percent", 1}, [of, share](const Score& s) -> SummaryValue {
              const Shares* shares = of(s);
              return shares ? 100 * (shares->*share) : kNone;
            }};
  };
  return {percent("within_1px", &Shares::within_1px),   percent("within_2px", &Shares::within_2px),
          percent("within_3px", &Shares::within_3px),   percent("within_5px", &Shares::within_5px),
          percent("within_10px", &Shares::within_10px), percent("area_10px", &Shares::area_10px)};
}

/// The entries of both, in this order.
template <class Score>
std::vector<Entry<Score>> joined(std::vector<Entry<Score>> first,
                                 const std::vector<Entry<Score>>& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

}  // namespace kestrel
