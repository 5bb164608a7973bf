#include "bench/absence.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/stress_texture.hpp"
#include "support/random.hpp"
#include "support/shared_sequence.hpp"

namespace kestrel::test {
namespace {

constexpr std::size_t kFramesPerSequence = 20;
const char* const kSamples = "/usr/share/doc/opencv-doc/examples/";

struct Subject {
  std::string name;
  std::vector<std::string> files;
  std::vector<std::string> sequences;  // of the developers' data
};

/// Pictures that no texture and no sequence shows.
std::vector<Subject> samples() {
  const std::string cv = kSamples;
  std::vector<Subject> subjects;
  for (const char* name : {"baboon", "blox", "orange", "apple", "messi5", "stuff", "HappyFish"}) {
    subjects.push_back({name, {cv + "data/" + name + ".jpg"}, {}});
  }
  for (const char* name : {"cards", "smarties", "pic1", "pic3"}) {
    subjects.push_back({name, {cv + "data/" + name + ".png"}, {}});
  }
  for (const char* name : {"000", "001", "002"}) {
    subjects.push_back({name, {cv + "hfs/data/" + name + ".jpg"}, {}});
  }
  subjects.push_back({"sign", {cv + "text/scenetext02.jpg"}, {}});
  subjects.push_back({"house", {cv + "reg/home.png"}, {}});
  subjects.push_back({"table", {cv + "reg/LR_05.png", cv + "reg/LR_06.png"}, {}});
  subjects.push_back({"head", {cv + "data/Blender_Suzanne1.jpg"}, {}});
  subjects.push_back({"notebook", {cv + "data/ela_original.jpg"}, {}});
  subjects.push_back({"solvay",
                      {"/usr/share/visp-images-data/ViSP-images/Solvay/"
                       "Solvay_conference_1927_Version2_1280x881.png"},
                      {}});
  return subjects;
}

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const StressTexture& texture : stress_textures()) {
    all.push_back({texture.name, {texture.file}, {}});
    all.push_back({texture.name + " wall", {texture.wall_file}, {}});
  }
  const auto named = [&](const std::string& name) {
    return std::find_if(all.begin(), all.end(), [&](const Subject& s) { return s.name == name; });
  };
  named("graffiti")->files.push_back(std::string(kSamples) + "data/graf3.png");
  named("graffiti")->sequences.emplace_back("graf");
  named("comic")->sequences.emplace_back("apt_vcube_comic");
  named("box")->files.push_back(std::string(kSamples) + "data/box_in_scene.png");
  for (const char* name : {"apt_chess_left", "apt_mire2", "bruegel", "cube_orbit", "mural_pilot",
                           "mural_tree", "postcard_a", "pot_V25_2", "uav_marina", "witch_screen"}) {
    all.push_back({name, {}, {name}});
  }
  const std::vector<Subject> more = samples();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Frames of a sequence, evenly spaced.
AbsencePictures sequence_pictures(const std::string& name) {
  const SharedData data = load_shared(name);
  if (!data.sequence) return {{}, {data.why_not}};
  AbsencePictures result;
  const std::vector<cv::Mat>& frames = data.sequence->frames;
  const std::size_t n = std::min(kFramesPerSequence, frames.size());
  for (std::size_t i = 0; i < n; ++i) {
    const cv::Mat& frame = frames[i * frames.size() / n];
    if (!frame.empty()) result.pictures.push_back(frame.clone());
  }
  return result;
}

cv::Matx33d turn(double angle) {
  return {std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1};
}

/// A view of the picture's part about a random point.
cv::Mat view(const cv::Mat& picture, Random& random) {
  const double scale = std::exp2(random.uniform(-1, 1.6));
  cv::Mat shrunk = picture;
  const double first = std::min(1., scale);  // averaged, so that a small view has no aliases
  if (first < 1) cv::resize(picture, shrunk, {}, first, first, cv::INTER_AREA);
  const double tilt = random.uniform(0, 40 * M_PI / 180);
  const double axis = random.uniform(0, 2 * M_PI);
  const cv::Matx33d centred(1, 0, -random.uniform(0.2, 0.8) * shrunk.cols, 0, 1,
                            -random.uniform(0.2, 0.8) * shrunk.rows, 0, 0, 1);
  const cv::Matx33d sized(scale / first, 0, 0, 0, scale / first, 0, 0, 0, 1);
  const cv::Matx33d tilted(1, 0, 0, 0, std::cos(tilt), 0, 0, std::sin(tilt) / 600, 1);
  const cv::Matx33d placed(1, 0, 319.5, 0, 1, 239.5, 0, 0, 1);
  const cv::Matx33d H = placed * turn(random.uniform(-M_PI, M_PI)) * turn(axis) * tilted *
                        turn(-axis) * sized * centred;
  cv::Mat result;
  cv::warpPerspective(shrunk, result, H, {640, 480}, cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
  const double blur_px = random.uniform(-1.5, 1.5);
  if (blur_px > 0.3) cv::GaussianBlur(result, result, {}, blur_px);
  result.convertTo(result, CV_8U, random.uniform(0.6, 1.4), random.uniform(-25, 25));
  const int sigma = random.integer(0, 6);
  for (int i = 0; sigma > 0 && i < int(result.total()); ++i) {
    const double noise = random.uniform(-1, 1) * std::sqrt(3.) * sigma;
    result.data[i] = cv::saturate_cast<uchar>(result.data[i] + noise);
  }
  return result;
}

class AbsenceSource final : public FrameSource {
 public:
  explicit AbsenceSource(AbsenceOptions options)
      : options_(std::move(options)), pictures_(absence_pictures(options_.absent)) {}

  std::optional<Frame> next() override {
    if (next_ >= options_.frames) return std::nullopt;
    Random random("absence " + std::to_string(options_.seed) + " " + std::to_string(next_));
    const cv::Mat& picture =
        pictures_.pictures[std::size_t(random.integer(0, int(pictures_.pictures.size()) - 1))];
    Frame frame{next_, double(next_) / 30, {}, {}};
    frame.gray = next_ % 4 == 0 ? picture.clone() : view(picture, random);
    ++next_;
    return frame;
  }
  const std::vector<std::string>& skipped() const override { return pictures_.missing; }
  std::optional<std::int64_t> frame_count() const override { return options_.frames; }

 private:
  AbsenceOptions options_;
  AbsencePictures pictures_;
  std::int64_t next_ = 0;
};

}  // namespace

std::vector<std::string> absence_subjects() {
  std::vector<std::string> names;
  for (const Subject& subject : subjects()) names.push_back(subject.name);
  return names;
}

AbsencePictures absence_pictures(const std::string& absent) {
  AbsencePictures all;
  for (const Subject& subject : subjects()) {
    if (subject.name == absent) continue;
    for (const std::string& file : subject.files) all.pictures.push_back(load_picture(file));
    for (const std::string& name : subject.sequences) {
      const AbsencePictures more = sequence_pictures(name);
      all.pictures.insert(all.pictures.end(), more.pictures.begin(), more.pictures.end());
      all.missing.insert(all.missing.end(), more.missing.begin(), more.missing.end());
    }
  }
  return all;
}

void AbsenceOptions::check() const {
  const std::vector<std::string> names = absence_subjects();
  if (!absent.empty() && std::find(names.begin(), names.end(), absent) == names.end()) {
    throw std::invalid_argument("absent: there is no subject " + absent);
  }
  if (frames < 1) throw std::invalid_argument("frames: must be at least 1");
}

std::unique_ptr<FrameSource> absence_frames(const AbsenceOptions& options) {
  options.check();
  return std::make_unique<AbsenceSource>(options);
}

}  // namespace kestrel::test
