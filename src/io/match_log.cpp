#include "kestrel/io/match_log.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "kestrel/io/text_file.hpp"

namespace kestrel {
namespace {

constexpr const char* kHeader = "frame,agree_u_v_px,others_u_v_px";

std::vector<Pixel> places(const std::vector<PixelPair>& pairs) {
  std::vector<Pixel> all;
  const std::size_t count = std::min(pairs.size(), MatchLog::kMost);
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) all.push_back(pairs[i].in_image);
  return all;
}

std::string text(const std::vector<Pixel>& pixels) {
  std::string all;
  for (const Pixel& p : pixels) {
    fmt::format_to(std::back_inserter(all), "{}{:.1f} {:.1f}", all.empty() ? "" : " ", p.u, p.v);
  }
  return all;
}

/// The places in a field; empty for anything else.
std::optional<std::vector<Pixel>> pixels(std::string_view field) {
  std::vector<double> numbers;
  while (!field.empty()) {
    const std::size_t end = std::min(field.find(' '), field.size());
    const auto value = csv_number(field.substr(0, end));
    if (!value) return std::nullopt;
    numbers.push_back(*value);
    field.remove_prefix(std::min(end + 1, field.size()));
  }
  if (numbers.size() % 2 != 0) return std::nullopt;
  std::vector<Pixel> all;
  for (std::size_t i = 0; i < numbers.size(); i += 2) all.push_back({numbers[i], numbers[i + 1]});
  return all;
}

}  // namespace

LoggedMatches logged_matches(const Track& track) {
  return {places(track.inliers), places(track.others)};
}

MatchLog::MatchLog(const std::filesystem::path& path) : file_(path) { file_.write(kHeader); }

void MatchLog::write(std::int64_t frame, const Track& track) {
  if (track.inliers.empty() && track.others.empty()) return;
  const LoggedMatches kept = logged_matches(track);
  file_.write(fmt::format("{},{},{}", frame, text(kept.inliers), text(kept.others)));
}

std::map<std::int64_t, LoggedMatches> read_matches(const std::filesystem::path& path) {
  std::map<std::int64_t, LoggedMatches> all;
  if (!std::filesystem::exists(path)) return all;
  std::ifstream lines(path);  // of a long run it is larger than read_text takes
  std::string line;
  if (!std::getline(lines, line) || line != kHeader) {
    throw FileError(path, 1, "",
                    std::string("does not begin with ") + kHeader + "; remove the file");
  }
  for (int number = 2; std::getline(lines, line); ++number) {
    if (lines.eof()) break;  // no end of line: cut short
    const auto fields = csv_fields(line);
    const auto frame = fields.size() == 3 ? csv_number(fields[0]) : std::nullopt;
    const auto agree = frame ? pixels(fields[1]) : std::nullopt;
    const auto others = frame ? pixels(fields[2]) : std::nullopt;
    if (!agree || !others) {
      throw FileError(path, number, "", "is no number and two lists of places; remove the file");
    }
    all[std::int64_t(*frame)] = {*agree, *others};
  }
  return all;
}

}  // namespace kestrel
