#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace kestrel {

/// A number, a count, a word or a yes/no.
using SummaryValue = std::variant<double, std::int64_t, std::string, bool>;

/// One line of a summary.
struct SummaryItem {
  std::string section;
  std::string name;
  SummaryValue value;
  std::string unit;  // "px", "m/s", "%"; empty for none
};

/// What a run came to: named values with units, in order, in sections.
class Summary {
 public:
  /// The items added from here on belong to this section.
  void begin_section(const std::string& name) { section_ = name; }

  void add(const std::string& name, double value, const std::string& unit = "");
  void add(const std::string& name, std::int64_t value, const std::string& unit = "");
  void add(const std::string& name, int value, const std::string& unit = "");
  void add(const std::string& name, bool value);
  void add(const std::string& name, const std::string& value);
  void add(const std::string& name, const char* value);

  /// Takes over an item of another summary, into this one's present section.
  void add(const SummaryItem& item) { append(item.name, item.value, item.unit); }

  const std::vector<SummaryItem>& items() const { return items_; }

 private:
  void append(const std::string& name, SummaryValue value, const std::string& unit);

  std::string section_;
  std::vector<SummaryItem> items_;
};

/// The value as a reader wants it: four significant digits, yes/no, "n/a" for a number that is not
/// finite.
std::string shown(const SummaryValue& value);

/// The name of an item in JSON: words joined by "_", the unit behind: "mean corner error" in px is
/// "mean_corner_error_px".
std::string json_key(const std::string& name, const std::string& unit);

/// The summary as lines for a terminal: names to the left, values aligned at the decimal point.
std::string text_table(const Summary& summary);

/// The summary as a JSON object (an object for each section), in order, full precision; null for a
/// number that is not finite. Throws std::invalid_argument for two items of one key.
std::string json(const Summary& summary);

/// Writes json(summary) to a file. Throws std::runtime_error as write_text.
void write_summary(const std::filesystem::path& path, const Summary& summary);

}  // namespace kestrel
