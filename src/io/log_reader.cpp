#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>

#include "log_visit.hpp"

namespace kestrel {
namespace {

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw std::runtime_error(where + what + "; was it edited? take the log as the run left it");
}

double parsed(std::string_view text, double) { return csv_number(text).value(); }

template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
Integer parsed(std::string_view text, Integer) {
  Integer value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) throw std::bad_optional_access();
  return value;
}

bool parsed(std::string_view text, bool) {
  if (text != "0" && text != "1") throw std::bad_optional_access();
  return text == "1";
}

/// The one of these whose name is the text.
template <class Names>
typename Names::value_type named(std::string_view text, const Names& all) {
  for (const auto one : all)
    if (text == name(one)) return one;
  throw std::bad_optional_access();
}

Miss parsed(std::string_view text, Miss) { return named(text, kMisses); }
TrackStatus parsed(std::string_view text, TrackStatus) { return named(text, kTrackStatuses); }
TrackStage parsed(std::string_view text, TrackStage) { return named(text, kTrackStages); }

CommandState parsed(std::string_view text, CommandState) { return named(text, kCommandStates); }

// Counts the fields that have text.
struct Filled {
  const std::map<std::string, std::string_view>* fields;
  int filled = 0;
  int count = 0;

  template <class Value>
  void operator()(const char* column, const Value&) {
    ++count;
    filled += fields->at(column).empty() ? 0 : 1;
  }
};

// Fills a row from the texts of its fields.
struct Values {
  std::string where;  // "file:line: "
  std::map<std::string, std::string_view> fields;

  template <class Value>
  void operator()(const char* column, Value& value) {
    const std::string_view text = fields.at(column);
    try {
      value = parsed(text, Value{});
    } catch (const std::bad_optional_access&) {
      fail(where, std::string(column) + ": cannot read '" + std::string(text) + "'");
    }
  }
  template <class Value, class Fields>
  void group(std::optional<Value>& value, Fields visit_fields) {
    Filled filled{&fields};
    visit_fields(value.emplace(), filled);
    if (filled.filled == 0) return value.reset();
    visit_fields(*value, *this);
  }
};

struct Header {
  std::vector<std::string> columns;
  std::vector<std::string> extra;
};

Header header(const std::string& line, const std::string& where) {
  Header out;
  const std::vector<std::string> fixed = log_columns();
  for (const std::string_view field : csv_fields(line)) {
    out.columns.emplace_back(field);
    if (std::find(fixed.begin(), fixed.end(), field) == fixed.end()) out.extra.emplace_back(field);
  }
  for (const std::string& column : fixed)
    if (std::find(out.columns.begin(), out.columns.end(), column) == out.columns.end())
      fail(where, column + ": no such column");
  return out;
}

LogRow row(const std::string& line, const Header& header, const std::string& where) {
  const std::vector<std::string_view> texts = csv_fields(line);
  if (texts.size() != header.columns.size())
    fail(where, std::to_string(texts.size()) + " fields for " +
                    std::to_string(header.columns.size()) + " columns");
  Values values{where, {}};
  for (std::size_t i = 0; i < texts.size(); ++i) values.fields[header.columns[i]] = texts[i];
  LogRow out;
  log_format::visit(out, values);
  for (const std::string& column : header.extra) {
    double& value = out.extra.emplace_back(std::numeric_limits<double>::quiet_NaN());
    if (!values.fields[column].empty()) values(column.c_str(), value);
  }
  return out;
}

}  // namespace

LogFile read_log(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot read the run log; check the path");
  LogFile out;
  std::optional<Header> columns;
  std::string line;
  for (long number = 1; std::getline(file, line); ++number) {
    if (file.eof()) {  // a whole line ends with a newline
      out.was_interrupted = true;
      break;
    }
    const std::string where = path.string() + ":" + std::to_string(number) + ": ";
    if (!columns)
      out.extra_columns = columns.emplace(header(line, where)).extra;
    else
      out.rows.push_back(row(line, *columns, where));
  }
  if (!columns) fail(path.string() + ":1: ", "no header");
  return out;
}

std::vector<double> LogFile::extra(const std::string& column) const {
  const auto at = std::find(extra_columns.begin(), extra_columns.end(), column);
  std::vector<double> values;
  if (at == extra_columns.end()) return values;
  const auto index = std::size_t(at - extra_columns.begin());
  for (const LogRow& row : rows) values.push_back(row.extra.at(index));
  return values;
}

}  // namespace kestrel
