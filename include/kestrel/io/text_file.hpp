#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace kestrel {

/// A mistake in a file that a human wrote or named: `file:line: key: what is wrong; remedy`.
class FileError : public std::runtime_error {
 public:
  /// line counts from 1, 0: the whole file; key empty: none.
  FileError(const std::filesystem::path& file, int line, const std::string& key,
            const std::string& what);
};

/// The bytes of a text file, without a byte order mark. Throws FileError when it is missing (and
/// names the nearest name in the folder), is a folder, cannot be read, is larger than 16 MB or
/// holds a zero byte (binary, or UTF-16).
std::string read_text(const std::filesystem::path& file);

/// A finite decimal number written the plain way (12, -0.5, 1e-3) and nothing else. Throws
/// std::invalid_argument that says what is wrong and what to write: not a number, .nan, .inf,
/// out of range, or a leading zero (YAML reads 010 as 8).
double parse_number(std::string_view text);

/// A whole number written the plain way, with the same refusals.
std::int64_t parse_integer(std::string_view text);

/// A text in quotes as YAML takes it, whatever is in it; control characters become spaces.
std::string yaml_quoted(const std::string& text);

/// The known word nearest to `word` by edit distance or as a beginning, or empty when none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace kestrel
