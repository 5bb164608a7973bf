#include "kestrel/lab/trace_csv.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "kestrel/io/csv.hpp"

namespace kestrel {
namespace {

[[noreturn]] void fail(std::size_t line, const std::string& what) {
  throw std::invalid_argument("trace: line " + std::to_string(line) + ": " + what);
}

/// Appends a row; a benchmark has millions of numbers, so none is a string of its own.
void append(std::string& text, const std::vector<double>& row) {
  std::array<char, 32> digits{};
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) text += ',';
    if (std::isnan(row[i])) continue;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), row[i]).ptr;
    text.append(digits.data(), end);
  }
  text += '\n';
}

std::vector<double> row_of(std::string_view text, std::size_t columns, std::size_t line) {
  std::vector<double> row;
  row.reserve(columns);
  for (const std::string_view field : csv_fields(text)) {
    const auto value = csv_number(field);
    if (!value && !field.empty()) fail(line, "'" + std::string(field) + "' is no number");
    row.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (row.size() != columns) fail(line, "has not as many values as there are columns");
  return row;
}

}  // namespace

std::string trace_csv(const RunTrace& trace) {
  std::string text;
  for (const std::string& name : trace.columns) text += (text.empty() ? "" : ",") + name;
  text += '\n';
  text.reserve(text.size() + trace.rows.size() * trace.columns.size() * 20);
  for (std::size_t i = 0; i < trace.rows.size(); ++i) {
    if (trace.rows[i].size() != trace.columns.size()) {
      fail(i + 2, "has not as many values as there are columns");
    }
    append(text, trace.rows[i]);
  }
  return text;
}

RunTrace trace_of_csv(const std::string& text) {
  RunTrace trace;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) fail(line + 1, "is not whole");
    const std::string_view words = std::string_view(text).substr(begin, end - begin);
    if (++line == 1) {
      for (const std::string_view name : csv_fields(words)) trace.columns.emplace_back(name);
    } else {
      trace.rows.push_back(row_of(words, trace.columns.size(), line));
    }
    begin = end + 1;
  }
  if (line == 0) fail(1, "is missing");
  return trace;
}

}  // namespace kestrel
