#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kestrel {

/// Shortest decimal that reads back as the same double, in any locale; "nan", "inf", "-inf".
std::string number(double value);

/// The double that all of text spells (number's inverse); empty for anything else.
std::optional<double> csv_number(std::string_view text);

/// The fields of one line of CSV without quotes, as number and plain words need none.
std::vector<std::string_view> csv_fields(std::string_view line);

/// A text file that grows line by line. Each line is handed to the operating system before write
/// returns, so a killed process leaves whole lines.
class LineFile {
 public:
  /// Creates or empties the file. Throws std::runtime_error with path, cause and remedy.
  explicit LineFile(const std::filesystem::path& path);

  /// Appends line and a newline. Throws std::runtime_error (path, cause, remedy) when the disk does
  /// not take it.
  void write(std::string_view line);

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// Writes text as the whole content of a file. Throws std::runtime_error with path, cause, remedy.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace kestrel
