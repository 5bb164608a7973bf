#include "kestrel/eval/table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kestrel/io/csv.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMissing = "\u2013";

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string csv_cell(const SummaryValue& value) {
  if (const auto* real = std::get_if<double>(&value))
    return std::isfinite(*real) ? number(*real) : "";
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const auto* yes = std::get_if<bool>(&value)) return *yes ? "true" : "false";
  return quoted(std::get<std::string>(value));
}

Json json_cell(const SummaryValue& value) {
  if (const auto* real = std::get_if<double>(&value))
    return std::isfinite(*real) ? Json(*real) : Json(nullptr);
  if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
  if (const auto* yes = std::get_if<bool>(&value)) return *yes;
  return std::get<std::string>(value);
}

std::string words(const SummaryValue& value, int digits) {
  if (const auto* real = std::get_if<double>(&value))
    return std::isfinite(*real) ? fmt::format("{:.{}f}", *real, digits) : kMissing;
  return shown(value);
}

/// "median_px" -> "median (px)".
std::string heading(const std::string& name) {
  static const std::pair<const char*, const char*> units[] = {
      {"_percent", "%"}, {"_per_s", "1/s"}, {"_rad_s", "rad/s"}, {"_m_s", "m/s"},
      {"_px", "px"},     {"_ms", "ms"},     {"_s", "s"},         {"_frames", "frames"}};
  std::string text = name;
  for (const auto& [ending, unit] : units) {
    const std::string end = ending;
    if (text.size() <= end.size() || text.substr(text.size() - end.size()) != end) continue;
    text = text.substr(0, text.size() - end.size()) + " (" + unit + ")";
    break;
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// Characters on the screen of UTF-8 text.
std::size_t width(const std::string& text) {
  return std::size_t(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

void require(const Table& table, const std::vector<SummaryValue>& row) {
  if (row.size() != table.columns.size()) {
    throw std::invalid_argument("table: a row has " + std::to_string(row.size()) + " values for " +
                                std::to_string(table.columns.size()) + " columns");
  }
}

std::string line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                 const std::vector<bool>& is_text) {
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string space(widths[i] - width(cells[i]), ' ');
    out += (i == 0 ? "" : "  ") + (is_text[i] ? cells[i] + space : space + cells[i]);
  }
  return out.substr(0, out.find_last_not_of(' ') + 1) + '\n';
}

}  // namespace

std::string csv(const Table& table) {
  std::string out;
  for (const Column& column : table.columns) out += (out.empty() ? "" : ",") + quoted(column.name);
  out += '\n';
  for (const auto& row : table.rows) {
    require(table, row);
    for (std::size_t i = 0; i < row.size(); ++i) out += (i == 0 ? "" : ",") + csv_cell(row[i]);
    out += '\n';
  }
  return out;
}

std::string json(const Table& table, int indent) {
  Json list = Json::array();
  for (const auto& row : table.rows) {
    require(table, row);
    Json object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      object[table.columns[i].name] = json_cell(row[i]);
    }
    list.push_back(std::move(object));
  }
  return list.dump(indent, ' ', false, Json::error_handler_t::replace);
}

ReportTable readable(const Table& table) {
  ReportTable out;
  for (const Column& column : table.columns) out.head.push_back(heading(column.name));
  for (const auto& row : table.rows) {
    require(table, row);
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < row.size(); ++i) {
      cells.push_back(words(row[i], table.columns[i].digits));
    }
    out.rows.push_back(std::move(cells));
  }
  return out;
}

std::string aligned(const ReportTable& table) {
  std::vector<std::size_t> widths;
  std::vector<bool> is_text(table.head.size(), false);
  for (const std::string& cell : table.head) widths.push_back(width(cell));
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], width(row[i]));
      if (!csv_number(row[i]) && row[i] != kMissing) is_text[i] = true;
    }
  }
  std::string out = table.caption.empty() ? "" : table.caption + '\n';
  out += line(table.head, widths, is_text);
  for (const auto& row : table.rows) out += line(row, widths, is_text);
  return out;
}

}  // namespace kestrel
