#include "kestrel/io/contact_sheet.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

std::vector<int> numbers(const std::vector<ReportPicture>& pictures) {
  std::vector<int> out;
  for (const ReportPicture& picture : pictures)
    out.push_back(std::stoi(picture.caption.substr(picture.caption.find_first_of("0123456789"))));
  return out;
}

TEST(ContactSheet, SpacesPicturesEvenly) {
  for (const int length : {6, 7, 23, 24, 25, 100, 1000, 4321}) {
    ContactSheet sheet(6, 0);
    for (int i = 0; i < length; ++i) sheet.offer(cv::Mat(2, 2, CV_8UC1), std::to_string(i));
    const auto kept = numbers(sheet.pictures());
    ASSERT_EQ(kept.size(), 6u);
    EXPECT_EQ(kept.front(), 0);
    // At least 12 are kept of which 6 are chosen: gaps differ by one of these at most.
    const double gap = length / 5.;
    for (std::size_t i = 1; i < kept.size(); ++i) {
      EXPECT_GT(kept[i], kept[i - 1]);
      EXPECT_NEAR(kept[i] - kept[i - 1], gap, 1 + length / 12.);
    }
    EXPECT_GE(kept.back(), length - 1 - length / 12.);
  }
}

TEST(ContactSheet, DrawsOnlyWhatItKeeps) {
  ContactSheet sheet(2, 1);
  int drawn = 0;
  const auto draw = [&] {
    ++drawn;
    return cv::Mat(2, 2, CV_8UC1);
  };
  for (int i = 0; i < 1000; ++i) sheet.offer(draw, std::to_string(i), i == 500 ? 1 : 0);
  EXPECT_GE(drawn, 3);
  EXPECT_LE(drawn, 60);  // 9 before each of seven doublings of the stride, half of them again, 1
}

TEST(ContactSheet, KeepsTheWorstInOrderOfTime) {
  ContactSheet sheet(0, 3);
  const double badness[] = {1, 9, std::nan(""), 0, 7, 2, 8, -4};
  for (int i = 0; i < 8; ++i) sheet.offer(cv::Mat(2, 2, CV_8UC1), std::to_string(i), badness[i]);
  EXPECT_EQ(numbers(sheet.pictures()), (std::vector<int>{1, 4, 6}));
  EXPECT_EQ(sheet.pictures().front().caption, "worst: 1");
}

TEST(ContactSheet, OwnsItsPictures) {
  ContactSheet sheet(1, 1);
  cv::Mat picture(2, 2, CV_8UC1, cv::Scalar(7));
  sheet.offer(picture, "0", 1);
  const ReportPicture as_offered = report_picture("0", picture);
  picture.setTo(0);
  ASSERT_EQ(sheet.pictures().size(), 2u);
  for (const ReportPicture& kept : sheet.pictures()) {
    EXPECT_EQ(kept.jpeg, as_offered.jpeg);
    EXPECT_EQ(kept.width_px, 2);
  }
}

TEST(ContactSheet, MayBeEmpty) {
  EXPECT_TRUE(ContactSheet(6, 3).pictures().empty());
  ContactSheet sheet(6, 3);
  sheet.offer(cv::Mat(2, 2, CV_8UC1), "0");
  EXPECT_EQ(sheet.pictures().size(), 1u);
}

}  // namespace
}  // namespace kestrel
