#include "cli/rendered_sequence.hpp"

#include <cmath>
#include <fstream>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "kestrel/sim/texture.hpp"

namespace kestrel::test {
namespace {

constexpr int kSide = 120;

/// Where the poster is in frame k: a similarity about its centre, with a drift.
cv::Matx33d image_from_poster(int k) {
  const double angle = 0.01 * std::min(k, 20);
  const double scale = 1 + 0.005 * std::min(k, 20);
  const double drift = 20 * std::sin(k * 0.05);
  const double c = scale * std::cos(angle);
  const double s = scale * std::sin(angle);
  const double half = (kSide - 1) / 2.0;
  return {c, -s, 160 + drift - c * half + s * half, s, c, 120 - s * half - c * half, 0, 0, 1};
}

}  // namespace

RenderedSequence rendered_sequence(const std::filesystem::path& folder, int frames) {
  std::filesystem::create_directories(folder);
  const cv::Mat picture = poster(kSide, kSide, 7);
  std::ofstream truth(folder / "truth.csv");
  truth << "frame,x0,y0,x1,y1,x2,y2,x3,y3\n";
  truth.precision(12);
  for (int k = 0; k < frames; ++k) {
    const cv::Matx33d H = image_from_poster(k);
    cv::Mat image(240, 320, CV_8UC1, cv::Scalar(128));
    cv::warpPerspective(picture, image, H, image.size(), cv::INTER_CUBIC, cv::BORDER_TRANSPARENT);
    char name[16];
    std::snprintf(name, sizeof name, "%04d.png", k);
    cv::imwrite((folder / name).string(), image, {cv::IMWRITE_PNG_COMPRESSION, 1});
    truth << k;
    for (const cv::Vec3d& corner :
         {cv::Vec3d(0, 0, 1), cv::Vec3d(kSide - 1, 0, 1), cv::Vec3d(kSide - 1, kSide - 1, 1),
          cv::Vec3d(0, kSide - 1, 1)}) {
      const cv::Vec3d p = H * corner;
      truth << ',' << p[0] << ',' << p[1];
    }
    truth << '\n';
  }
  return {"101,61,118,118"};
}

}  // namespace kestrel::test
