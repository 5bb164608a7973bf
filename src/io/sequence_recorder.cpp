#include "kestrel/io/sequence_recorder.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "kestrel/io/gray_image.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder, error))) {
    throw std::runtime_error(folder.string() +
                             ": is there already; name a new folder, nothing is written over");
  }
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": cannot be made: " + error.message());
}

}  // namespace

SequenceRecorder::SequenceRecorder(const fs::path& output, RecordingWords words, double rate_hz)
    : words_(std::move(words)) {
  if (output.extension() == ".mp4") {
    if (fs::exists(output))
      throw std::runtime_error(output.string() + ": is there already; name another file");
    result_ = output;
    video_ = std::make_unique<VideoWriter>(output, rate_hz, VideoTimes::OfPictures);
    stamps_ = std::make_unique<LineFile>(fs::path(output).replace_extension(".csv"));
  } else {
    make_folder(output);
    folder_ = output;
    result_ = output / "sequence.yaml";
    stamps_ = std::make_unique<LineFile>(output / "stamps.csv");
  }
  stamps_->write("frame,stamp_s");
}

void SequenceRecorder::write(std::int64_t index, double stamp_s, const cv::Mat& gray) {
  if (video_) {
    video_->write(gray, stamp_s);
    result_ = video_->path();
  } else {
    if (pictures_ == 0) describe(gray.size());
    save_png(folder_ / fmt::format("{:06d}.png", index), gray);
  }
  stamps_->write(std::to_string(index) + "," + number(stamp_s));
  ++pictures_;
  if (video_ && !video_->is_whole()) {
    throw std::runtime_error(result_.string() +
                             ": the disk took no more; free some space, or choose another folder");
  }
}

void SequenceRecorder::close() {
  if (video_) video_->close();
}

void SequenceRecorder::describe(const cv::Size& size) const {
  const cv::Size half(std::max(size.width / 2, 1), std::max(size.height / 2, 1));
  const cv::Point corner(size.width / 4, size.height / 4);
  const PixelBox middle{double(corner.x), double(corner.y), double(half.width),
                        double(half.height)};
  const PixelBox box = words_.template_px.value_or(middle);
  const char* const note = words_.template_px ? "" : "  # the middle: put your own rectangle here";
  write_text(result_, fmt::format("images: \"%06d.png\"\n"
                                  "first_number: 0\n"
                                  "stamps: stamps.csv\n"
                                  "template_px: [{}, {}, {}, {}]{}\n"
                                  "what: {}\n"
                                  "origin: kestrel record\n"
                                  "licence: not said\n",
                                  box.u, box.v, box.width, box.height, note,
                                  yaml_quoted("recorded from " + words_.source)));
}

}  // namespace kestrel
