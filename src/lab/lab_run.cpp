#include "kestrel/lab/lab_run.hpp"

#include <algorithm>

namespace kestrel {

std::vector<double> RunTrace::column(const std::string& wanted) const {
  const auto found = std::find(columns.begin(), columns.end(), wanted);
  if (found == columns.end()) return {};
  const auto index = std::size_t(found - columns.begin());
  std::vector<double> values;
  values.reserve(rows.size());
  for (const std::vector<double>& row : rows) values.push_back(row[index]);
  return values;
}

}  // namespace kestrel
