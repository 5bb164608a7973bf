#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kestrel/vision/frame.hpp"

/// Frames that do not show a template, to prove that nothing is found in them.
namespace kestrel::test {

/// Subjects by name: those of stress_textures() and of the developers' sequences (a sequence is its
/// own subject, but for "graf", which is "graffiti", and "apt_vcube_comic", which is "comic"), and
/// single pictures of Debian. All pictures of one subject may show the same things.
std::vector<std::string> absence_subjects();

/// The pictures that frames are made of, and why others are missing.
struct AbsencePictures {
  std::vector<cv::Mat> pictures;     // 8-bit grey, any size; 20 frames of each sequence
  std::vector<std::string> missing;  // one sentence each
};

/// Of all subjects but one.
AbsencePictures absence_pictures(const std::string& absent);

struct AbsenceOptions {
  std::string absent = "graffiti";  // the template's subject: no frame shows it; "": no template
  std::int64_t frames = 4000;
  std::uint64_t seed = 1;

  /// Throws std::invalid_argument for a subject nobody has, or no frames.
  void check() const;
};

/// Frames that show everything but the absent subject: of each four one is a picture as it is, in
/// its own size, three are 640x480 views of one, at half to three times its size, turned by any
/// angle, tilted to 40 degrees, with noise, blur and another contrast. Frame k depends on the
/// options and k only. Sequences that are not installed are named in skipped().
std::unique_ptr<FrameSource> absence_frames(const AbsenceOptions& options);

}  // namespace kestrel::test
