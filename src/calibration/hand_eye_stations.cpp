#include "kestrel/calibration/hand_eye_stations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "kestrel/geometry/rotation.hpp"
#include "kestrel/io/csv.hpp"
#include "kestrel/io/text_file.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = M_PI / 180;

/// A column of numbers and what they are multiplied by.
struct Column {
  std::size_t index = 0;
  double unit = 1;
};

/// The lines of a text without their ends; an empty last one is none.
std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// The columns of a header by name.
class Header {
 public:
  Header(const fs::path& file, std::string_view line) : file_(file) {
    for (const std::string_view name : csv_fields(line)) {
      if (!columns_.emplace(name, columns_.size()).second)
        throw FileError(file, 1, std::string(name), "is given twice; remove one");
    }
  }
  std::optional<std::size_t> find(const std::string& name) const {
    const auto at = columns_.find(name);
    return at == columns_.end() ? std::nullopt : std::optional(at->second);
  }
  Column of(const std::string& name) const {
    if (const auto at = find(name)) return {*at, 1};
    throw FileError(file_, 1, name, "is missing; add this column (or give the run.csv of a run)");
  }
  Column angle(const std::string& name) const {
    const auto radians = find(name + "_rad");
    const auto degrees = find(name + "_deg");
    if (radians && degrees)
      throw FileError(file_, 1, name + "_deg",
                      "is given together with _rad; remove one of the two");
    if (degrees) return {*degrees, kDegree};
    return of(name + "_rad");
  }
  std::size_t size() const { return columns_.size(); }

 private:
  fs::path file_;
  std::map<std::string, std::size_t, std::less<>> columns_;
};

/// What is read of each row.
struct Layout {
  std::vector<Column> needed;  // stamp, roll, pitch, yaw, three of translation, three of rotation
  std::vector<Column> position;
  std::optional<std::size_t> rival;
};

Layout layout_of(const Header& header) {
  Layout l;
  l.needed.push_back(header.of("stamp_s"));
  for (const char* name : {"roll", "pitch", "yaw"}) l.needed.push_back(header.angle(name));
  for (const char* name :
       {"pose_tx_m", "pose_ty_m", "pose_tz_m", "pose_tux_rad", "pose_tuy_rad", "pose_tuz_rad"})
    l.needed.push_back(header.of(name));
  l.rival = header.find("has_rival");
  const std::array<const char*, 3> ned = {"north_m", "east_m", "down_m"};
  if (std::none_of(ned.begin(), ned.end(), [&](const char* n) { return header.find(n); })) return l;
  for (const char* name : ned) l.position.push_back(header.of(name));
  return l;
}

/// One row's fields as numbers.
struct Row {
  const fs::path& file;
  int line;
  std::vector<std::string_view> fields;

  /// Empty when one of the fields is.
  std::vector<double> values(const std::vector<Column>& columns) const {
    std::vector<double> out;
    for (const Column& column : columns) {
      const std::string_view field = fields[column.index];
      if (field.empty()) return {};
      const auto value = csv_number(field);
      if (!value || !std::isfinite(*value)) {
        throw FileError(file, line, "",
                        "'" + std::string(field) + "' is no number; write one, or nothing");
      }
      out.push_back(*value * column.unit);
    }
    return out;
  }
};

std::optional<HandEyeStation> station_of(const Row& row, const Layout& layout) {
  const std::vector<double> v = row.values(layout.needed);
  if (v.empty()) return std::nullopt;
  if (layout.rival && row.fields[*layout.rival] == "1") return std::nullopt;
  HandEyeStation s;
  s.stamp_s = v[0];
  s.attitude = {v[1], v[2], v[3]};
  s.camera_from_target = {rotation_from_vector({v[7], v[8], v[9]}), {v[4], v[5], v[6]}};
  const std::vector<double> p = row.values(layout.position);
  if (!p.empty()) s.position_ned_m = Eigen::Vector3d(p[0], p[1], p[2]);
  return s;
}

/// The angle between two attitudes, rad.
double turn_rad(const Attitude& a, const Attitude& b) {
  return rotation_vector(rotation_of(a).transpose() * rotation_of(b)).norm();
}

}  // namespace

void StationOptions::check() const {
  if (!(smallest_turn_rad >= 0 && smallest_turn_rad < 1))
    throw std::invalid_argument("smallest_turn_rad: at least 0, less than 1");
  if (most < 3) throw std::invalid_argument("most: at least 3");
}

std::vector<HandEyeStation> load_stations(const fs::path& file) {
  const std::string text = read_text(file);
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty()) throw FileError(file, 0, "", "is empty; give a header and rows");
  const Header header(file, lines[0]);
  const Layout layout = layout_of(header);
  std::vector<HandEyeStation> stations;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    const Row row{file, int(i) + 1, csv_fields(lines[i])};
    if (row.fields.size() != header.size()) {
      throw FileError(file, row.line, "",
                      "has " + std::to_string(row.fields.size()) + " fields; the header has " +
                          std::to_string(header.size()));
    }
    if (const auto station = station_of(row, layout)) stations.push_back(*station);
  }
  if (stations.empty()) {
    throw FileError(file, 0, "",
                    "has no row with attitude and pose; record with a source that gives the "
                    "attitude, and with the camera's calibration");
  }
  return stations;
}

std::vector<HandEyeStation> chosen_stations(const std::vector<HandEyeStation>& all,
                                            const StationOptions& options) {
  options.check();
  std::vector<HandEyeStation> apart;
  for (const HandEyeStation& s : all) {
    const bool is_new = std::all_of(apart.begin(), apart.end(), [&](const HandEyeStation& k) {
      return turn_rad(k.attitude, s.attitude) >= options.smallest_turn_rad;
    });
    if (is_new) apart.push_back(s);
  }
  const auto most = std::size_t(options.most);
  if (apart.size() <= most) return apart;
  std::vector<HandEyeStation> chosen;
  for (std::size_t i = 0; i < most; ++i)
    chosen.push_back(apart[i * (apart.size() - 1) / (most - 1)]);
  return chosen;
}

Eigen::Matrix3d rotation_of(const Attitude& attitude) {
  return rotation_from_rpy(attitude.roll, attitude.pitch, attitude.yaw);
}

}  // namespace kestrel
