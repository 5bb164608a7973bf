#include "kestrel/vision/match.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <opencv2/core.hpp>
#include <opencv2/flann/miniflann.hpp>

namespace kestrel {
namespace {

constexpr int kDescriptorLength = 128;
constexpr double kSamePlacePx = 1;

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

/// No descriptor: FLANN's search of numbers whose squares overflow, or of none, ends in an
/// assertion.
constexpr double kLargestNumber = 1e6;

bool are_descriptors(const cv::Mat& rows) {
  return rows.type() == CV_32FC1 && rows.cols == kDescriptorLength &&
         cv::checkRange(rows, true, nullptr, -kLargestNumber, kLargestNumber);
}

/// FLANN draws from cv::theRNG(), the generator of the calling thread: seeded here while a tree is
/// built, and put back afterwards so that nobody notices.
class SeededOpencv {
 public:
  explicit SeededOpencv(int seed) : state_before_(cv::theRNG().state) {
    cv::theRNG() = cv::RNG(std::uint64_t(seed));
  }
  ~SeededOpencv() { cv::theRNG().state = state_before_; }
  SeededOpencv(const SeededOpencv&) = delete;
  SeededOpencv& operator=(const SeededOpencv&) = delete;

 private:
  std::uint64_t state_before_;
};

bool same_place(const Pixel& a, const Pixel& b) {
  const double du = a.u - b.u;
  const double dv = a.v - b.v;
  return du * du + dv * dv < kSamePlacePx * kSamePlacePx;
}

/// Indices of matches, most distinctive first; ties in the order of the matches.
std::vector<std::size_t> by_ratio(const std::vector<Match>& matches) {
  std::vector<std::size_t> order(matches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return matches[a].ratio < matches[b].ratio;
  });
  return order;
}

}  // namespace

void MatchOptions::check() const {
  require(ratio > 0 && ratio < 1, "match.ratio: must be between 0 and 1");
  require(checks >= 2, "match.checks: must be at least 2");
}

struct Matcher::Index {
  cv::flann::Index tree;  // with a copy of the rows
  int rows = 0;
};

Matcher::Matcher(const cv::Mat& descriptors, const MatchOptions& options)
    : index_(std::make_unique<Index>()), options_(options) {
  options.check();
  require(are_descriptors(descriptors) && descriptors.rows >= 2,
          "descriptors: must be at least two rows of 128 finite floats");
  index_->rows = descriptors.rows;
  const SeededOpencv seeded(options.seed);
  index_->tree.build(descriptors, cv::flann::KDTreeIndexParams(1));
}

Matcher::~Matcher() = default;
Matcher::Matcher(Matcher&&) noexcept = default;
Matcher& Matcher::operator=(Matcher&&) noexcept = default;

std::vector<Match> Matcher::match(const cv::Mat& descriptors) const {
  if (descriptors.empty()) return {};
  require(are_descriptors(descriptors), "descriptors: must be rows of 128 finite floats");
  cv::Mat nearest;
  cv::Mat squared;
  index_->tree.knnSearch(descriptors, nearest, squared, 2,
                         cv::flann::SearchParams(options_.checks));
  std::vector<Match> best(std::size_t(index_->rows), Match{-1, -1, options_.ratio});
  for (int i = 0; i < descriptors.rows; ++i) {
    const double ratio = std::sqrt(double(squared.at<float>(i, 0)) / squared.at<float>(i, 1));
    Match& claim = best[std::size_t(nearest.at<int>(i, 0))];
    if (ratio < claim.ratio) claim = {nearest.at<int>(i, 0), i, ratio};  // false for 0/0
  }
  best.erase(
      std::remove_if(best.begin(), best.end(), [](const Match& m) { return m.in_image < 0; }),
      best.end());
  std::sort(best.begin(), best.end(),
            [](const Match& a, const Match& b) { return a.in_image < b.in_image; });
  return best;
}

std::vector<PixelPair> distinct_pairs(const std::vector<Match>& matches,
                                      const Keypoints& in_template, const Keypoints& in_image) {
  std::vector<PixelPair> pairs;
  pairs.reserve(matches.size());
  for (const Match& m : matches) {
    pairs.push_back(
        {in_template.at[std::size_t(m.in_template)], in_image.at[std::size_t(m.in_image)]});
  }
  std::vector<std::size_t> kept;
  for (const std::size_t i : by_ratio(matches)) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](std::size_t k) {
      return same_place(pairs[k].in_template, pairs[i].in_template) ||
             same_place(pairs[k].in_image, pairs[i].in_image);
    });
    if (is_new) kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  std::vector<PixelPair> distinct;
  distinct.reserve(kept.size());
  for (const std::size_t k : kept) distinct.push_back(pairs[k]);
  return distinct;
}

}  // namespace kestrel
