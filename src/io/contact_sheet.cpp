#include "kestrel/io/contact_sheet.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel {

void ContactSheet::offer(const std::function<cv::Mat()>& draw, const std::string& caption,
                         double badness) {
  const std::int64_t place = offered_++;
  const auto copy = [&] { return Kept{place, badness, report_picture(caption, draw())}; };
  if (even_ > 0 && place % stride_ == 0) spaced_.push_back(copy());
  if (spaced_.size() > 4 * std::size_t(even_)) {
    // Each doubling of the stride drops every other picture: memory stays bounded, spacing even.
    stride_ *= 2;
    const auto is_between = [&](const Kept& k) { return k.place % stride_ != 0; };
    spaced_.erase(std::remove_if(spaced_.begin(), spaced_.end(), is_between), spaced_.end());
  }
  if (worst_ <= 0 || !(badness > 0)) return;
  const auto milder = [](const Kept& a, const Kept& b) { return a.badness < b.badness; };
  const auto mildest = std::min_element(worst_kept_.begin(), worst_kept_.end(), milder);
  if (worst_kept_.size() < std::size_t(worst_))
    worst_kept_.push_back(copy());
  else if (badness > mildest->badness)
    *mildest = copy();
}

std::vector<ReportPicture> ContactSheet::pictures() const {
  std::vector<ReportPicture> out;
  const auto have = std::int64_t(spaced_.size());
  const std::int64_t count = std::min<std::int64_t>(even_, have);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t at = count == 1 ? 0 : (i * (have - 1) + (count - 1) / 2) / (count - 1);
    out.push_back(spaced_[std::size_t(at)].picture);
  }
  std::vector<Kept> worst = worst_kept_;
  std::sort(worst.begin(), worst.end(),
            [](const Kept& a, const Kept& b) { return a.place < b.place; });
  for (Kept& kept : worst) {
    kept.picture.caption = "worst: " + kept.picture.caption;
    out.push_back(std::move(kept.picture));
  }
  return out;
}

}  // namespace kestrel
