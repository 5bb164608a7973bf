#include "support/shared_sequence.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

namespace kestrel::test {
namespace {

namespace fs = std::filesystem;
using Keys = std::map<std::string, std::string>;

fs::path data_folder() {
  const char* chosen = std::getenv("KESTREL_DATA_DIR");  // NOLINT(concurrency-mt-unsafe)
  if (chosen != nullptr && *chosen != '\0') return chosen;
  return fs::path(KESTREL_SOURCE_DIR) / ".." / "shared" / "data";
}

Keys keys_of(const fs::path& file) {
  Keys keys;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (colon != std::string::npos) keys[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return keys;
}

std::int64_t number(const Keys& keys, const std::string& key) {
  const auto found = keys.find(key);
  return found == keys.end() ? 0 : std::stoll(found->second);
}

std::vector<cv::Mat> video(const fs::path& file, std::int64_t first, std::int64_t last) {
  std::vector<cv::Mat> frames;
  cv::VideoCapture capture(file.string());
  cv::Mat image;
  for (std::int64_t i = 0; i <= last && capture.read(image); ++i) {
    if (i < first) continue;
    cv::Mat gray;
    cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
    frames.push_back(gray);
  }
  return frames;
}

/// File names of "PATTERN (words)" or of "FOLDER: name name ... in this order".
std::vector<std::string> image_files(const fs::path& folder, const Keys& keys) {
  std::istringstream words(keys.at("images"));
  std::string pattern;
  words >> pattern;
  std::vector<std::string> files;
  if (pattern.back() == ':') {
    const fs::path place = folder / pattern.substr(0, pattern.size() - 1);
    for (std::string word; words >> word && word.find('.') != std::string::npos;) {
      files.push_back((place / word).string());
    }
    return files;
  }
  const std::int64_t shift = number(keys, "first_number");
  const auto at = pattern.find("%04d");
  for (auto i = number(keys, "first_frame"); i <= number(keys, "last_frame"); ++i) {
    std::array<char, 24> digits{};
    std::snprintf(digits.data(), digits.size(), "%04lld", static_cast<long long>(i) + shift);
    std::string file = pattern;
    files.push_back((folder / file.replace(at, 4, digits.data())).string());
  }
  return files;
}

std::vector<cv::Mat> images(const fs::path& folder, const Keys& keys) {
  const std::string& what = keys.at("images");
  if (what.find("%04d") == std::string::npos && what.find(": ") == std::string::npos) {
    return video(folder / what, number(keys, "first_frame"), number(keys, "last_frame"));
  }
  std::vector<cv::Mat> frames;
  for (const std::string& file : image_files(folder, keys)) {
    frames.push_back(fs::exists(file) ? cv::imread(file, cv::IMREAD_GRAYSCALE) : cv::Mat());
  }
  return frames;
}

std::map<std::int64_t, std::array<Pixel, 4>> truth_of(const fs::path& file) {
  std::map<std::int64_t, std::array<Pixel, 4>> rows;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);  // header
  while (std::getline(in, line)) {
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream numbers(line);
    std::int64_t frame = 0;
    std::array<Pixel, 4> corners;
    numbers >> frame;
    for (Pixel& p : corners) numbers >> p.u >> p.v;
    if (numbers) rows[frame] = corners;
  }
  return rows;
}

/// The rectangle to select; the box of the first row of truth where the folder names none.
PixelBox template_of(const Keys& keys, const std::array<Pixel, 4>& corners) {
  const auto found = keys.find("template_rect");
  std::istringstream numbers(found == keys.end() ? "" : found->second);
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
  if (numbers >> left >> top >> right >> bottom) return {left, top, right - left, bottom - top};
  return clipped(bounding_box({corners.begin(), corners.end()}), 1 << 15, 1 << 15);
}

}  // namespace

SharedData load_shared(const std::string& name) {
  const fs::path folder = data_folder() / name;
  if (!fs::exists(folder / "sequence.txt")) {
    return {std::nullopt, "no sequence " + name + " in " + data_folder().string() +
                              "; set KESTREL_DATA_DIR to the folder that holds it"};
  }
  const Keys keys = keys_of(folder / "sequence.txt");
  SharedSequence sequence;
  sequence.frames = images(folder, keys);
  sequence.first_frame = number(keys, "first_frame");
  sequence.truth = truth_of(folder / "gt.csv");
  if (sequence.frames.empty() || sequence.frames.front().empty() || sequence.truth.empty()) {
    return {std::nullopt, "the images of " + name + " are not installed: " + keys.at("images")};
  }
  sequence.template_box = template_of(keys, sequence.truth.begin()->second);
  return {sequence, ""};
}

std::optional<double> corner_error_px(const SharedSequence& sequence, std::int64_t frame,
                                      const Homography& image_from_template) {
  const auto row = sequence.truth.find(frame);
  if (row == sequence.truth.end()) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Pixel& first = sequence.truth.begin()->second[i];
    const Pixel in_template{first.u - sequence.template_box.u, first.v - sequence.template_box.v};
    sum += distance(image_from_template * in_template, row->second[i]);
  }
  return sum / 4;
}

}  // namespace kestrel::test
