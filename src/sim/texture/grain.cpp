#include "grain.hpp"

#include <opencv2/imgproc.hpp>

namespace kestrel::sim_detail {

cv::Mat clouds(cv::Size size, double coarsest_px, double fade, RandomStream& random) {
  cv::Mat sum(size, CV_32F, cv::Scalar(0));
  double weight = 1 - fade;
  double cell = coarsest_px;
  while (cell >= 2) {
    cv::Mat lattice(int(size.height / cell) + 2, int(size.width / cell) + 2, CV_32F);
    for (int i = 0; i < lattice.rows * lattice.cols; ++i) {
      lattice.ptr<float>()[i] = float(random.uniform(-1, 1));
    }
    cv::Mat smooth;
    cv::resize(lattice, smooth, size, 0, 0, cv::INTER_CUBIC);
    cv::scaleAdd(smooth, weight, sum, sum);
    cell /= 2;
    weight *= fade;
  }
  return sum;
}

cv::Mat grained(const cv::Mat& picture, const cv::Mat& noise, double gain) {
  cv::Mat sum;
  cv::addWeighted(picture, 1, noise, gain, 0, sum, CV_8U);
  return sum;
}

}  // namespace kestrel::sim_detail
