#include "kestrel/io/csv.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace kestrel {
namespace {

[[noreturn]] void fail(const std::string& path, int cause) {
  std::string remedy = "check the path and its permissions";
  if (cause == ENOSPC || cause == EDQUOT) remedy = "free some space or choose another folder";
  if (cause == ENOENT) remedy = "create its folder first";
  if (cause == EISDIR) remedy = "give the name of a file";
  throw std::runtime_error(path + ": cannot write: " + std::strerror(cause) + "; " + remedy);
}

void put(std::FILE* file, const std::string& path, std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fflush(file) != 0)
    fail(path, errno);
}

std::FILE* opened(const std::string& path) {
  errno = 0;
  std::FILE* file = std::fopen(path.c_str(), "we");
  if (!file) fail(path, errno);
  return file;
}

}  // namespace

std::string number(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::optional<double> csv_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> csv_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    fields.push_back(line.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return fields;
}

LineFile::LineFile(const std::filesystem::path& path)
    : path_(path.string()), file_(opened(path_)) {}

void LineFile::write(std::string_view line) {
  std::string text(line);
  text += '\n';
  put(file_.get(), path_, text);
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  const std::string name = path.string();
  std::FILE* file = opened(name);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int cause = errno;
  if (std::fclose(file) != 0 || !written) fail(name, written ? errno : cause);
}

}  // namespace kestrel
