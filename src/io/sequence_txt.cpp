#include "kestrel/io/sequence_txt.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "kestrel/io/truth_file.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

struct Value {
  int line = 0;
  std::string text;
};

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// The lines of a description by their keys.
class Lines {
 public:
  explicit Lines(const fs::path& file) : file_(file) {
    std::istringstream text(read_text(file));
    int number = 0;
    for (std::string line; std::getline(text, line);) {
      ++number;
      if (trimmed(line).empty()) continue;
      const auto colon = line.find(':');
      if (colon == std::string::npos) {
        throw FileError(file, number, "", "is no 'key: value'; write one");
      }
      const std::string key = trimmed(line.substr(0, colon));
      if (!values_.emplace(key, Value{number, trimmed(line.substr(colon + 1))}).second) {
        throw FileError(file, number, key, "is given twice; remove one");
      }
    }
  }

  std::string text(const std::string& key) const {
    const auto value = values_.find(key);
    return value == values_.end() ? "" : value->second.text;
  }

  /// A frame or file number.
  std::optional<std::int64_t> count(const std::string& key) const {
    if (text(key).empty()) return std::nullopt;
    std::int64_t number = 0;
    try {
      number = parse_integer(text(key));
    } catch (const std::invalid_argument& error) {
      fail(key, error.what());
    }
    if (number < 0) fail(key, "is negative; frames count from 0");
    return number;
  }

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    const auto value = values_.find(key);
    throw FileError(file_, value == values_.end() ? 0 : value->second.line, key, what);
  }

  /// A path that is written relative to the file.
  fs::path path(const std::string& text) const {
    return (file_.parent_path() / text).lexically_normal();
  }

 private:
  fs::path file_;
  std::map<std::string, Value> values_;
};

/// The package in "... (Debian visp-images-data)"; empty when none is named.
std::string package_of(const std::string& note) {
  constexpr std::string_view kDebian = "(Debian ";
  const auto at = note.find(kDebian);
  if (at == std::string::npos) return "";
  const auto begin = at + kDebian.size();
  return note.substr(begin, note.find_first_of(" )", begin) - begin);
}

SequenceOptions options_of(const Lines& lines) {
  const std::string images = lines.text("images");
  SequenceOptions options;
  options.package = package_of(images);
  const std::string said = trimmed(images.substr(0, images.find(" (")));
  if (said.empty()) lines.fail("images", "is missing; name a video, a pattern or a list");
  const auto list = said.find(": ");
  options.input = lines.path(said.substr(0, list)).string();
  if (list != std::string::npos) {
    std::istringstream names(said.substr(list + 2, said.find(" in this order") - list - 2));
    for (std::string name; names >> name;) options.files.push_back(fs::path(options.input) / name);
  }
  options.first_number = lines.count("first_number");
  options.first_frame = lines.count("first_frame").value_or(0);
  options.last_frame = lines.count("last_frame");
  if (options.last_frame.value_or(options.first_frame) < options.first_frame) {
    lines.fail("last_frame", "comes before first_frame; raise it");
  }
  return options;
}

PixelBox whole_pixels_inside(const std::array<Pixel, 4>& corners) {
  const PixelBox around = bounding_box({corners.begin(), corners.end()});
  const double u = std::ceil(around.u);
  const double v = std::ceil(around.v);
  return {u, v, std::floor(around.u + around.width - 1) - u + 1,
          std::floor(around.v + around.height - 1) - v + 1};
}

PixelBox rectangle_of(const Lines& lines, const std::optional<fs::path>& truth) {
  const std::string text = lines.text("template_rect");
  if (text.empty()) {
    if (!truth) lines.fail("template_rect", "is missing; give x0 y0 x1 y1");
    return whole_pixels_inside(load_truth(*truth).begin()->second);
  }
  std::istringstream words(text);
  std::vector<double> at;
  try {
    for (std::string word; words >> word;) at.push_back(double(parse_integer(word)));
  } catch (const std::invalid_argument& error) {
    lines.fail("template_rect", error.what());
  }
  if (at.size() != 4 || at[0] < 0 || at[1] < 0 || at[2] < at[0] || at[3] < at[1]) {
    lines.fail("template_rect", "is '" + text + "'; give x0 y0 x1 y1, whole pixels, in this order");
  }
  return {at[0], at[1], at[2] - at[0] + 1, at[3] - at[1] + 1};
}

}  // namespace

SequenceDescription load_sequence_txt(const fs::path& file) {
  const Lines lines(file);
  SequenceDescription description;
  description.file = file;
  description.sequence = options_of(lines);
  const fs::path truth = lines.path("gt.csv");
  if (fs::exists(truth)) description.truth = truth;
  description.template_px = rectangle_of(lines, description.truth);
  description.what = lines.text("object");
  description.origin = lines.text("source");
  description.licence = lines.text("licence");
  return description;
}

}  // namespace kestrel
