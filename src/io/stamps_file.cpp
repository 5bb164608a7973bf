#include "kestrel/io/stamps_file.hpp"

#include <cmath>
#include <sstream>
#include <string>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/text_file.hpp"

namespace kestrel {

std::map<std::int64_t, double> load_stamps(const std::filesystem::path& file) {
  std::istringstream text(read_text(file));
  std::map<std::int64_t, double> stamps;
  int line = 0;
  for (std::string row; std::getline(text, row);) {
    ++line;
    if (!row.empty() && row.back() == '\r') row.pop_back();
    if (line == 1) {
      if (row == "frame,stamp_s") continue;
      throw FileError(file, line, "", "the first line must be 'frame,stamp_s'");
    }
    const auto fields = csv_fields(row);
    const auto frame = csv_number(fields[0]);
    const auto stamp_s = fields.size() == 2 ? csv_number(fields[1]) : std::nullopt;
    const bool is_row = frame && stamp_s && std::isfinite(*stamp_s) && *frame >= 0 &&
                        *frame < 1e15 && *frame == std::floor(*frame);
    if (!is_row) throw FileError(file, line, "", "is no 'frame,stamp_s' of two numbers");
    const auto last = stamps.rbegin();
    if (last != stamps.rend() && !(double(last->first) < *frame && last->second < *stamp_s))
      throw FileError(file, line, "", "frame and stamp must be greater than in the line before");
    stamps.emplace(std::int64_t(*frame), *stamp_s);
  }
  return stamps;
}

StampOf stamps_at(double rate_hz) {
  return [rate_hz](std::int64_t index) { return double(index) / rate_hz; };
}

StampOf stamps_in(const std::filesystem::path& file) {
  return [stamps = load_stamps(file)](std::int64_t index) -> std::optional<double> {
    const auto it = stamps.find(index);
    return it == stamps.end() ? std::nullopt : std::optional(it->second);
  };
}

}  // namespace kestrel
