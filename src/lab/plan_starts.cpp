#include "kestrel/io/csv.hpp"
#include "kestrel/io/text_file.hpp"
#include "kestrel/lab/lab_plan_file.hpp"

namespace kestrel {
namespace {

constexpr const char* kHead = "tx_m,ty_m,tz_m,tux_rad,tuy_rad,tuz_rad";

}  // namespace

std::filesystem::path starts_file(const PlannedBasin& basin) {
  return std::filesystem::path("starts") / (basin.name + ".csv");
}

std::string starts_csv(const std::vector<StartPose>& starts) {
  std::string text = std::string(kHead) + '\n';
  for (const StartPose& start : starts) {
    std::string line;
    for (const double value : start.translation_m) line += number(value) + ',';
    for (const double value : start.rotation_vector_rad) line += number(value) + ',';
    line.back() = '\n';
    text += line;
  }
  return text;
}

std::vector<StartPose> load_starts(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  std::vector<StartPose> starts;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view words = std::string_view(text).substr(begin, end - begin);
    if (!words.empty() && words.back() == '\r') words.remove_suffix(1);
    begin = end + 1;
    if (++line == 1) {
      if (words != kHead) throw FileError(file, 1, "", std::string("is no ") + kHead);
      continue;
    }
    if (words.empty()) continue;
    std::vector<double> values;
    for (const std::string_view field : csv_fields(words)) {
      try {
        values.push_back(parse_number(field));
      } catch (const std::invalid_argument& error) {
        throw FileError(file, line, "", error.what());
      }
    }
    if (values.size() != 6) throw FileError(file, line, "", "has not six numbers; give six");
    starts.push_back({{values[0], values[1], values[2]}, {values[3], values[4], values[5]}});
  }
  return starts;
}

}  // namespace kestrel
