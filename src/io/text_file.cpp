#include "kestrel/io/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>
#include <system_error>

namespace kestrel {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestText = 16u << 20;

std::string message(const fs::path& file, int line, const std::string& key,
                    const std::string& what) {
  std::string text = file.string();
  if (line > 0) text += ":" + std::to_string(line);
  text += ": ";
  if (!key.empty()) text += key + ": ";
  return text + what;
}

/// What to do about a file that is not there.
std::string missing_remedy(const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    return "the folder " + folder.string() + " does not exist; correct the path";
  }
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  const std::string near = nearest_word(file.filename().string(), names);
  return near.empty() ? "correct the path" : "did you mean " + near + "?";
}

/// Levenshtein's distance.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

bool begins_with(const std::string& text, const std::string& start) {
  return start.size() >= 3 && text.compare(0, start.size(), start) == 0;
}

}  // namespace

FileError::FileError(const fs::path& file, int line, const std::string& key,
                     const std::string& what)
    : std::runtime_error(message(file, line, key, what)) {}

std::string read_text(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (file.empty()) throw FileError("(no file)", 0, "", "the file name is empty; name a file");
  if (!fs::exists(status)) {
    throw FileError(file, 0, "", "there is no such file; " + missing_remedy(file));
  }
  if (fs::is_directory(status)) {
    throw FileError(file, 0, "", "is a folder, not a file; name a file in it");
  }
  if (fs::is_regular_file(status) && fs::file_size(file, error) > kLargestText) {
    throw FileError(file, 0, "", "is larger than 16 MB, so no text file of ours; correct the path");
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw FileError(file, 0, "",
                    std::string("cannot be read (") + std::strerror(errno) +
                        "); check who owns it and its permissions");
  }
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
  const auto zero = text.find('\0');
  if (zero != std::string::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(zero), '\n');
    throw FileError(file, int(line), "",
                    "is no text (zero byte: binary or UTF-16); save it as UTF-8 text");
  }
  return text;
}

double parse_number(std::string_view text) {
  const std::string said = "'" + std::string(text) + "' ";
  std::string_view digits = text;
  if (!digits.empty() && (digits[0] == '+' || digits[0] == '-')) digits.remove_prefix(1);
  std::string lower(digits);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  for (const char* word : {".nan", "nan", ".inf", "inf", "infinity"}) {
    if (lower == word) throw std::invalid_argument(said + "is not finite; write a finite number");
  }
  if (digits.size() > 1 && digits[0] == '0' && digits[1] >= '0' && digits[1] <= '9') {
    throw std::invalid_argument(
        said + "begins with a zero, which YAML reads as octal; write it without the zero");
  }
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value,
                                            std::chars_format::general);
  const bool begins_well =
      !digits.empty() && (digits[0] == '.' || (digits[0] >= '0' && digits[0] <= '9'));
  if (error == std::errc::result_out_of_range) {
    throw std::invalid_argument(said + "is too large or too small for a number; correct it");
  }
  if (!begins_well || error != std::errc() || end != digits.data() + digits.size()) {
    throw std::invalid_argument(said + "is not a number; write one such as 0.5 or 1e-3");
  }
  return text[0] == '-' ? -value : value;
}

std::int64_t parse_integer(std::string_view text) {
  parse_number(text);
  std::string_view digits = text;
  if (digits[0] == '+') digits.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    throw std::invalid_argument("'" + std::string(text) +
                                "' is not a whole number; write one such as 10");
  }
  return value;
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = word.size() < 3 ? 0 : word.size() / 3 + 1;
  for (const std::string& candidate : known) {
    const bool beginning = begins_with(candidate, word) || begins_with(word, candidate);
    const std::size_t d = beginning ? std::size_t{1} : edit_distance(word, candidate);
    if (d < best_distance) {
      best_distance = d;
      best = candidate;
    }
  }
  return best;
}

std::string yaml_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + '"';
}

}  // namespace kestrel
