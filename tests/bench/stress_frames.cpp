// stress_frames FOLDER [CLASS TEXTURE [STEP]]: frames of the rendered sequences as PNG files, the
// true outline drawn on them, to be looked at.
#include <iostream>
#include <string>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/guarded.hpp"
#include "bench/stress.hpp"
#include "bench/stress_texture.hpp"

namespace {

using kestrel::test::StressSequence;

void write(const StressSequence& sequence, const std::string& start, std::int64_t step) {
  const auto source = sequence.sequence.open();
  while (const auto frame = source->next()) {
    if (frame->index % step != 0) continue;
    cv::Mat picture;
    cv::cvtColor(frame->gray, picture, cv::COLOR_GRAY2BGR);
    const auto row = sequence.sequence.truth.find(frame->index);
    for (std::size_t i = 0; row != sequence.sequence.truth.end() && i < 4; ++i) {
      const auto& a = row->second[i];
      const auto& b = row->second[(i + 1) % 4];
      cv::line(picture, {cvRound(a.u), cvRound(a.v)}, {cvRound(b.u), cvRound(b.v)}, {0, 0, 255});
    }
    cv::imwrite(start + std::to_string(frame->index) + ".png", picture);
  }
}

int run(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "stress_frames FOLDER [CLASS TEXTURE [STEP]]\n";
    return 1;
  }
  const std::int64_t step = argc > 4 ? std::stoll(argv[4]) : 25;
  for (const std::string& cls : kestrel::test::stress_classes()) {
    if (argc > 2 && cls != argv[2]) continue;
    const std::string texture = argc > 3 ? argv[3] : "graffiti";
    std::string start = argv[1];
    start.append("/").append(cls).append("_").append(texture).append("_");
    write(kestrel::test::stress_sequence({cls, texture, 150, 1}), start, step);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return kestrel::test::guarded(run, argc, argv); }
