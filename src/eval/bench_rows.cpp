#include "bench_rows.hpp"

#include <cctype>
#include <map>
#include <sstream>
#include <stdexcept>

#include "kestrel/eval/bench_score.hpp"
#include "kestrel/io/csv.hpp"

namespace kestrel {
namespace {

constexpr const char* kFrameColumns =
    "frame,state,h00,h01,h02,h10,h11,h12,h20,h21,h22,window_u_px,window_v_px,window_width_px,"
    "window_height_px,keypoints,matches,inliers,error_px";
constexpr const char* kTimeColumns = "frame,cpu_ms";
constexpr double kMilli = 1e-3;

/// A word that can stand in a CSV file.
std::string word(std::string text) {
  for (char& c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  }
  return text;
}

std::string frame_row(const BenchFrame& f, const std::optional<double>& error_px) {
  std::string row = std::to_string(f.frame) + ',' + word(f.answer.state);
  for (int i = 0; i < 9; ++i) {
    row += ',';
    if (f.answer.image_from_template) row += number(f.answer.image_from_template->H(i / 3, i % 3));
  }
  const PixelBox& w = f.answer.window;
  for (const double value : {w.u, w.v, w.width, w.height}) row += ',' + number(value);
  for (const int value : {f.answer.keypoints, f.answer.matches, f.answer.inliers}) {
    row += ',' + std::to_string(value);
  }
  return row + ',' + (error_px ? number(*error_px) : "") + '\n';
}

double value(std::string_view field) {
  const auto number = csv_number(field);
  if (!number) throw std::runtime_error("no number: " + std::string(field));
  return *number;
}

BenchFrame frame_of(const std::string& line) {
  constexpr std::size_t kColumns = 19;
  const auto fields = csv_fields(line);
  if (fields.size() != kColumns) throw std::runtime_error("no row of a run: " + line);
  BenchFrame f;
  f.frame = std::int64_t(value(fields[0]));
  f.answer.state = std::string(fields[1]);
  if (!fields[2].empty()) {
    Homography H;
    for (std::size_t i = 0; i < 9; ++i) {
      H.H(Eigen::Index(i / 3), Eigen::Index(i % 3)) = value(fields[2 + i]);
    }
    f.answer.image_from_template = H;
  }
  f.answer.window = {value(fields[11]), value(fields[12]), value(fields[13]), value(fields[14])};
  f.answer.keypoints = int(value(fields[15]));
  f.answer.matches = int(value(fields[16]));
  f.answer.inliers = int(value(fields[17]));
  return f;
}

/// The rows of a text below this header.
std::vector<std::string> rows_below(const std::string& header, const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> rows;
  std::string line;
  if (!std::getline(lines, line) || line != header) throw std::runtime_error("another header");
  while (std::getline(lines, line)) rows.push_back(line);
  return rows;
}

double time_of(const std::string& line, const std::string& what) {
  const auto fields = csv_fields(line);
  if (fields.size() != 2 || fields[0] != what) throw std::runtime_error("no time: " + line);
  return value(fields[1]) * kMilli;
}

}  // namespace

std::string frames_csv(const BenchRun& run, const TrackTruth& truth) {
  std::map<std::int64_t, std::optional<double>> errors;
  for (const FrameScore& score : frame_scores(judged_by(truth, run), estimate_of(run))) {
    errors[score.frame] = score.error_px;
  }
  std::string text = std::string(kFrameColumns) + '\n';
  for (const BenchFrame& frame : run.frames) text += frame_row(frame, errors[frame.frame]);
  return text;
}

std::string times_csv(const BenchRun& run) {
  std::string text = std::string(kTimeColumns) + "\nlearn," + number(run.learn_s / kMilli) + '\n';
  for (const BenchFrame& frame : run.frames) {
    text += std::to_string(frame.frame) + ',' + number(frame.time_s / kMilli) + '\n';
  }
  return text;
}

void read_rows(BenchRun& run, const std::string& frames, const std::string& times) {
  for (const std::string& line : rows_below(kFrameColumns, frames)) {
    run.frames.push_back(frame_of(line));
  }
  const std::vector<std::string> rows = rows_below(kTimeColumns, times);
  if (rows.size() != run.frames.size() + 1) throw std::runtime_error("times of another run");
  run.learn_s = time_of(rows[0], "learn");
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    run.frames[i].time_s = time_of(rows[i + 1], std::to_string(run.frames[i].frame));
  }
}

}  // namespace kestrel
