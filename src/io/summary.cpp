#include "kestrel/io/summary.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kestrel/io/csv.hpp"

namespace kestrel {
namespace {

using Json = nlohmann::ordered_json;

Json json_value(const SummaryValue& value) {
  if (const auto* real = std::get_if<double>(&value))
    return std::isfinite(*real) ? Json(*real) : Json(nullptr);
  if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
  if (const auto* yes = std::get_if<bool>(&value)) return *yes;
  return std::get<std::string>(value);
}

bool is_number(const SummaryValue& value) {
  return std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
}

// Characters on the screen of UTF-8 text.
std::size_t width(const std::string& text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  }));
}

std::size_t before_point(const SummaryItem& item) {
  if (!is_number(item.value)) return 0;
  const std::string text = shown(item.value);
  return std::min(text.find_first_of(".e"), text.size());
}

std::string spaces(std::size_t count) { return std::string(count, ' '); }

}  // namespace

void Summary::append(const std::string& name, SummaryValue value, const std::string& unit) {
  items_.push_back({section_, name, std::move(value), unit});
}
void Summary::add(const std::string& name, double value, const std::string& unit) {
  append(name, value, unit);
}
void Summary::add(const std::string& name, std::int64_t value, const std::string& unit) {
  append(name, value, unit);
}
void Summary::add(const std::string& name, int value, const std::string& unit) {
  append(name, std::int64_t(value), unit);
}
void Summary::add(const std::string& name, bool value) { append(name, value, ""); }
void Summary::add(const std::string& name, const std::string& value) { append(name, value, ""); }
void Summary::add(const std::string& name, const char* value) {
  append(name, std::string(value), "");
}

std::string shown(const SummaryValue& value) {
  if (const auto* real = std::get_if<double>(&value))
    return std::isfinite(*real) ? fmt::format("{:.4g}", *real) : "n/a";
  if (const auto* count = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *count);
  if (const auto* yes = std::get_if<bool>(&value)) return *yes ? "yes" : "no";
  return std::get<std::string>(value);
}

std::string json_key(const std::string& name, const std::string& unit) {
  const std::string suffix = unit == "%" ? "percent" : unit == "°" ? "deg" : unit;
  std::string words = name;
  words.append(" ").append(suffix);
  std::string key;
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalnum(byte))
      key += char(std::tolower(byte));
    else if (!key.empty() && key.back() != '_')
      key += '_';
  }
  while (!key.empty() && key.back() == '_') key.pop_back();
  return key;
}

std::string text_table(const Summary& summary) {
  std::size_t names = 0;
  std::size_t whole = 0;
  for (const SummaryItem& item : summary.items()) {
    names = std::max(names, width(item.name));
    whole = std::max(whole, before_point(item));
  }
  std::string out;
  std::string section;
  for (const SummaryItem& item : summary.items()) {
    if (item.section != section) out += (out.empty() ? "" : "\n") + item.section + "\n";
    section = item.section;
    const std::size_t shift = is_number(item.value) ? whole - before_point(item) : 0;
    out += "  " + item.name + spaces(names - width(item.name) + 2 + shift) + shown(item.value);
    out += (item.unit.empty() ? "" : " " + item.unit) + "\n";
  }
  return out;
}

std::string json(const Summary& summary) {
  Json root = Json::object();
  for (const SummaryItem& item : summary.items()) {
    const std::string key = json_key(item.name, item.unit);
    const std::string section = json_key(item.section, "");
    Json& object = section.empty() ? root : root[section];
    if (object.is_object() ? object.contains(key) : !object.is_null())
      throw std::invalid_argument("summary: two values named " + key);
    object[key] = json_value(item.value);
  }
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  write_text(path, json(summary));
}

}  // namespace kestrel
