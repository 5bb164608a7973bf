#include "kestrel/io/image_files.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <regex>
#include <stdexcept>
#include <vector>

namespace kestrel {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A file name cut into runs of digits and of other characters.
struct NaturalKey {
  std::vector<std::pair<std::string, std::string>> runs;  // other characters, digits without zeros
  std::string name;

  explicit NaturalKey(const std::string& file_name) : name(file_name) {
    for (std::size_t i = 0; i < name.size();) {
      std::string other;
      std::string digits;
      while (i < name.size() && !is_digit(name[i])) other += name[i++];
      while (i < name.size() && is_digit(name[i])) digits += name[i++];
      digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
      runs.emplace_back(other, digits);
    }
  }
};

bool natural_less(const NaturalKey& a, const NaturalKey& b) {
  for (std::size_t i = 0; i < a.runs.size() && i < b.runs.size(); ++i) {
    const auto& [other_a, digits_a] = a.runs[i];
    const auto& [other_b, digits_b] = b.runs[i];
    if (other_a != other_b) return other_a < other_b;
    if (digits_a.size() != digits_b.size()) return digits_a.size() < digits_b.size();
    if (digits_a != digits_b) return digits_a < digits_b;
  }
  if (a.runs.size() != b.runs.size()) return a.runs.size() < b.runs.size();
  return a.name < b.name;
}

}  // namespace

bool is_image_name(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  static const char* const known[] = {".pgm", ".ppm", ".pnm",  ".pbm",  ".png", ".jpg",
                                      ".bmp", ".tif", ".tiff", ".webp", ".jp2", ".jpeg"};
  return std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

NumberedFiles files_of_pattern(const std::string& pattern) {
  static const std::regex form("([^%]*)%(0([1-9]))?d([^%]*)");
  const fs::path path(pattern);
  const std::string name = path.filename().string();
  std::smatch part;
  if (!std::regex_match(name, part, form) ||
      path.parent_path().string().find('%') != std::string::npos) {
    throw std::runtime_error(pattern + ": is no pattern; write one %d or %04d in the file name");
  }
  const std::string before = part[1];
  const std::string after = part[4];
  const std::size_t width = part[3].matched ? std::size_t(part[3].str()[0] - '0') : 1;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  NumberedFiles files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string file = entry.path().filename().string();
    if (file.size() < before.size() + width + after.size()) continue;
    const std::string digits =
        file.substr(before.size(), file.size() - before.size() - after.size());
    if (file.compare(0, before.size(), before) != 0) continue;
    if (file.compare(file.size() - after.size(), after.size(), after) != 0) continue;
    if (!std::all_of(digits.begin(), digits.end(), is_digit)) continue;
    if (digits.size() > width && digits[0] == '0') continue;  // printf would not write it so
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc()) files.emplace(number, entry.path());
  }
  return files;
}

NumberedFiles files_of_folder(const fs::path& folder) {
  if (!fs::is_directory(folder)) return {{0, folder}};
  std::vector<NaturalKey> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory() && is_image_name(entry.path())) {
      names.emplace_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end(), natural_less);
  NumberedFiles files;
  for (std::size_t i = 0; i < names.size(); ++i) files.emplace(i, folder / names[i].name);
  return files;
}

}  // namespace kestrel
