#include "calibrate_views.hpp"

#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/calibration/guide_picture.hpp"
#include "kestrel/io/gray_image.hpp"
#include "kestrel/io/image_files.hpp"
#include "kestrel/io/sequence.hpp"
#include "kestrel/io/source_address.hpp"

#include "display.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "simulated_camera.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

bool is_camera(const std::string& input) {
  return is_source_address(input) && is_live(parse_source(input).kind);
}

/// The pictures that an input names; empty when it is a video or camera.
std::vector<fs::path> pictures_of(const std::string& input) {
  NumberedFiles files;
  if (is_camera(input)) return {};
  const bool is_pattern = fs::path(input).filename().string().find('%') != std::string::npos;
  if (is_pattern) {
    files = files_of_pattern(input);
  } else if (!fs::exists(input)) {
    throw std::runtime_error(input +
                             ": there is no such file; give pictures, a folder, a pattern "
                             "like left%02d.jpg, a video or camera:N");
  } else if (fs::is_directory(input) || is_image_name(input)) {
    files = files_of_folder(input);
  } else {
    return {};
  }
  if (files.empty()) throw std::runtime_error(input + ": there are no pictures there");
  std::vector<fs::path> list;
  for (const auto& [number, file] : files) list.push_back(file);
  return list;
}

void say(const std::string& name, const Offered& offered) {
  fmt::print(stderr, "{} {}: {}\n", offered.kept ? "+" : "-", name, offered.what);
}

void look_at_pictures(const std::vector<fs::path>& files, ViewCollector& views) {
  Progress progress(std::int64_t(files.size()), "picture");
  std::int64_t done = 0;
  for (const fs::path& file : files) {
    if (interrupted()) return;
    progress.step(done++, file.filename().string());
    Offered offered;
    try {
      offered = views.offer(file.filename().string(), load_gray(file));
    } catch (const FileError& error) {
      offered.what = error.what();
    }
    progress.clear();
    say(file.filename().string(), offered);
  }
}

/// What to do next, for whoever holds the board.
std::string hint(const ViewCollector& views, const Offered& offered) {
  const std::string next = offered.missing.empty() ? "enough" : offered.missing.front();
  return fmt::format("{} kept, {:.0f} %: {} ({})", views.views().size(), 100 * offered.progress,
                     next, offered.what);
}

/// Shows how the collecting goes, where that was asked for.
class GuideView {
 public:
  explicit GuideView(Guide guide) : guide_(guide) {}
  /// False once the user has had enough.
  bool show(const cv::Mat& gray, const Offered& offered, const ViewCollector& views) {
    if (guide_ == Guide::Lines) return true;
    const cv::Mat picture = guide_picture(gray, offered, views);
    if (!window_)
      window_ = std::make_unique<Window>(picture.cols, picture.rows, "Kestrel: calibrate");
    return window_->show(picture) != Click::Right;
  }

 private:
  Guide guide_;
  std::unique_ptr<Window> window_;
};

void look_at_frames(const std::string& input, ViewCollector& views, const LiveCapture& wanted) {
  SequenceOptions recorded;
  recorded.input = input;
  const bool live = is_camera(input);
  LiveOptions options;
  options.capture = wanted.capture;
  const auto source = live ? open_camera(input, options) : open_sequence(recorded);
  Progress progress(source->frame_count());
  std::vector<std::string> missing;
  std::string last_hint;
  GuideView window(wanted.guide);
  while (!interrupted()) {
    const auto frame = source->next();
    if (!frame) break;
    if (!has_image(*frame)) continue;  // the camera is silent
    const std::string name = fmt::format("frame {}", frame->index);
    const Offered offered = views.offer(name, frame->gray);
    missing = offered.missing;
    progress.step(frame->index, hint(views, offered));
    if (offered.kept) {
      progress.clear();
      say(name, offered);
    }
    const std::string next = missing.empty() ? "" : missing.front();
    if (live && next != last_hint) fmt::print(stderr, "  now: {}\n", next);
    last_hint = next;
    if (!window.show(frame->gray, offered, views)) break;
    if (live && missing.empty()) break;
  }
  progress.clear();
  for (const std::string& sentence : source->skipped()) fmt::print(stderr, "- {}\n", sentence);
  for (const std::string& wish : missing) fmt::print(stderr, "missing: {}\n", wish);
}

}  // namespace

ViewCollector collect_views(const std::vector<std::string>& inputs, const Board& board,
                            const GuideOptions& options, const LiveCapture& live) {
  std::vector<fs::path> pictures;
  std::string moving;
  for (const std::string& input : inputs) {
    const std::vector<fs::path> files = pictures_of(input);
    pictures.insert(pictures.end(), files.begin(), files.end());
    if (files.empty()) moving = input;
  }
  if (!moving.empty() && inputs.size() > 1)
    throw std::runtime_error(moving +
                             ": a video or camera stands alone; give it as the only input");
  if (!live.capture.is_empty() && (moving.empty() || !is_camera(moving)))
    throw std::invalid_argument(
        "--format, --size, --rate, --exposure, --gain and --trigger are for a live camera; "
        "pictures "
        "and videos are as they were taken");
  const Choose choose = moving.empty()      ? Choose::All
                        : is_camera(moving) ? Choose::Live
                                            : Choose::Guided;
  ViewCollector views(board, choose, options);
  if (moving.empty()) {
    look_at_pictures(pictures, views);
  } else {
    look_at_frames(moving, views, live);
  }
  return views;
}

}  // namespace kestrel::app
