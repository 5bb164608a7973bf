#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "kestrel/io/report.hpp"

namespace kestrel {

/// Keeps a few pictures of a run of unknown length: some evenly spaced in it, and the worst.
class ContactSheet {
 public:
  /// How many evenly spaced pictures and how many of the worst to end with, >= 0.
  ContactSheet(int even, int worst) : even_(even), worst_(worst) {}

  /// Offers the picture of the next frame; only when kept it is drawn and turned into a JPEG, whose
  /// bytes are all that stays in memory. badness: larger is worse;
  /// 0 or NaN: not to be among the worst.
  void offer(const std::function<cv::Mat()>& draw, const std::string& caption, double badness = 0);
  void offer(const cv::Mat& picture, const std::string& caption, double badness = 0) {
    offer([&] { return picture; }, caption, badness);
  }

  /// The evenly spaced pictures, the first of the run among them, then the worst in order of time
  /// ("worst: " before their captions).
  std::vector<ReportPicture> pictures() const;

 private:
  struct Kept {
    std::int64_t place = 0;
    double badness = 0;
    ReportPicture picture;
  };

  int even_;
  int worst_;
  std::int64_t offered_ = 0;
  std::int64_t stride_ = 1;  // every how many pictures one is kept
  std::vector<Kept> spaced_;
  std::vector<Kept> worst_kept_;
};

}  // namespace kestrel
