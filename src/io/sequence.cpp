#include "kestrel/io/sequence.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "kestrel/io/gray_image.hpp"
#include "kestrel/io/image_files.hpp"
#include "kestrel/io/stamps_file.hpp"
#include "kestrel/io/video_reader.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualRate_hz = 30;

[[noreturn]] void fail(const SequenceOptions& options, const std::string& what) {
  const std::string package =
      options.package.empty() ? "" : "; `apt-get install " + options.package + "` brings them";
  throw std::runtime_error(options.input + ": " + what + package);
}

/// Images in the order of their numbers.
class ImageSequence : public FrameSource {
 public:
  ImageSequence(NumberedFiles files, StampOf stamp_of)
      : files_(std::move(files)), stamp_of_(std::move(stamp_of)) {
    next_ = files_.begin();
    expected_ = next_->first;
  }

  std::optional<Frame> next() override {
    while (next_ != files_.end()) {
      const auto [index, file] = *next_++;
      for (; expected_ < index; ++expected_) {
        skipped_.push_back("frame " + std::to_string(expected_) + ": there is no such file");
      }
      ++expected_;
      try {
        const std::optional<double> stamp_s = stamp_of_(index);
        if (stamp_s) return Frame{index, *stamp_s, load_gray(file), std::nullopt};
        skipped_.push_back("frame " + std::to_string(index) + ": has no stamp");
      } catch (const FileError& error) {
        skipped_.push_back("frame " + std::to_string(index) + ": " + error.what());
      }
    }
    return std::nullopt;
  }

  const std::vector<std::string>& skipped() const override { return skipped_; }
  std::optional<std::int64_t> frame_count() const override { return std::int64_t(files_.size()); }

 private:
  NumberedFiles files_;
  NumberedFiles::const_iterator next_;
  std::int64_t expected_ = 0;
  StampOf stamp_of_;
  std::vector<std::string> skipped_;
};

/// The frames of a video file.
class VideoSequence : public FrameSource {
 public:
  explicit VideoSequence(const SequenceOptions& options)
      : reader_(options.input), last_(options.last_frame), rate_hz_(options.rate_hz) {
    promised_ = reader_.promised();
    for (; index_ < options.first_frame; ++index_) {
      if (!reader_.skip()) {
        fail(options, "has only " + std::to_string(index_) + " frames; lower first_frame");
      }
    }
    first_ = index_;
    read();
    if (!ahead_) fail(options, "holds no frame that can be decoded; re-encode it");
  }

  std::optional<Frame> next() override {
    std::optional<Frame> frame;
    frame.swap(ahead_);
    if (frame) read();
    return frame;
  }

  const std::vector<std::string>& skipped() const override { return skipped_; }

  std::optional<std::int64_t> frame_count() const override {
    if (promised_ <= 0) return std::nullopt;
    const std::int64_t last = std::min(last_.value_or(promised_ - 1), promised_ - 1);
    return std::max<std::int64_t>(last - first_ + 1, 0);
  }

 private:
  /// Decodes the next frame into ahead_, which stays empty at the end.
  void read() {
    if (last_ && index_ > *last_) return;
    const std::int64_t damaged = reader_.damaged();
    const auto picture = reader_.next();
    if (!picture) return note_early_end();
    for (std::int64_t lost = reader_.damaged() - damaged; lost > 0; --lost) {
      skipped_.push_back("frame " + std::to_string(index_++) + ": is damaged");
    }
    if (last_ && index_ > *last_) return;
    ahead_ = Frame{index_, stamp_s(*picture), picture->gray, std::nullopt};
    stamp_s_ = ahead_->stamp_s;
    ++index_;
  }

  /// By the rate that is asked for, else as the video says while that increases.
  double stamp_s(const VideoPicture& picture) const {
    const double rate_hz = rate_hz_.value_or(reader_.rate_hz().value_or(kUsualRate_hz));
    const double by_rate_s = double(index_) / rate_hz;
    if (rate_hz_) return by_rate_s;
    const double said_s = picture.time_s.value_or(by_rate_s);
    return !stamp_s_ || said_s > *stamp_s_ ? said_s : *stamp_s_ + 1 / rate_hz;
  }

  void note_early_end() {
    const std::int64_t wanted = last_ ? std::min(*last_ + 1, promised_) : promised_;
    if (index_ >= wanted) return;
    skipped_.push_back("frames " + std::to_string(index_) + " to " + std::to_string(wanted - 1) +
                       ": the video ends early (cut short or damaged)");
  }

  VideoReader reader_;
  std::optional<Frame> ahead_;
  std::optional<std::int64_t> last_;
  std::optional<double> rate_hz_;
  std::optional<double> stamp_s_;  // of the last frame given
  std::int64_t first_ = 0;
  std::int64_t index_ = 0;  // of the next frame
  std::int64_t promised_ = 0;
  std::vector<std::string> skipped_;
};

bool is_pattern(const SequenceOptions& options) {
  return options.files.empty() && options.input.find('%') != std::string::npos;
}

/// All images that are meant, by number.
NumberedFiles all_files(const SequenceOptions& options) {
  if (is_pattern(options)) return files_of_pattern(options.input);
  if (options.files.empty()) return files_of_folder(options.input);
  NumberedFiles files;
  for (std::size_t i = 0; i < options.files.size(); ++i) files.emplace(i, options.files[i]);
  const bool none = std::none_of(options.files.begin(), options.files.end(),
                                 [](const fs::path& file) { return fs::exists(file); });
  if (none) fail(options, "none of its images is there; correct their folder");
  return files;
}

/// The images by their index, within the range asked for.
NumberedFiles files_in_range(const SequenceOptions& options) {
  const bool pattern = is_pattern(options);
  const NumberedFiles all = all_files(options);
  if (all.empty()) {
    fail(options, pattern ? "no file has a name like this; correct the pattern"
                          : "the folder holds no image; name another");
  }
  const std::int64_t zero = pattern ? options.first_number.value_or(all.begin()->first) : 0;
  const std::int64_t last = options.last_frame.value_or(all.rbegin()->first - zero);
  NumberedFiles wanted;
  for (const auto& [number, file] : all) {
    const std::int64_t index = number - zero;
    if (index >= options.first_frame && index <= last) wanted.emplace(index, file);
  }
  if (wanted.empty()) {
    fail(options, "has images " + std::to_string(all.begin()->first - zero) + " to " +
                      std::to_string(all.rbegin()->first - zero) +
                      ", none in the range asked for; change first_frame or last_frame");
  }
  return wanted;
}

}  // namespace

std::unique_ptr<FrameSource> open_sequence(const SequenceOptions& options) {
  if (options.input.empty()) fail(options, "the sequence has no name; give a pattern or a file");
  if (options.rate_hz && !(std::isfinite(*options.rate_hz) && *options.rate_hz > 0)) {
    fail(options, "rate_hz must be positive");
  }
  if (options.first_frame < 0 || options.last_frame.value_or(0) < 0 ||
      options.last_frame.value_or(options.first_frame) < options.first_frame) {
    fail(options, "first_frame and last_frame must be 0 or more, in this order");
  }
  const bool one = options.files.empty() && !is_pattern(options);
  if (one && !fs::exists(options.input))
    fail(options, "there is no such file or folder; correct the path");
  if (one && fs::is_regular_file(options.input) && !is_image_name(options.input)) {
    return std::make_unique<VideoSequence>(options);
  }
  return std::make_unique<ImageSequence>(files_in_range(options),
                                         options.stamps && !options.rate_hz
                                             ? stamps_in(*options.stamps)
                                             : stamps_at(options.rate_hz.value_or(kUsualRate_hz)));
}

}  // namespace kestrel
