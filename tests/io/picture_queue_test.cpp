#include "kestrel/io/picture_queue.hpp"

#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

Picture picture(int grey, std::int64_t lost = 0) {
  return {cv::Mat(1, 1, CV_8UC1, cv::Scalar(grey)), double(grey), lost, ""};
}

TEST(PictureQueue, OfOneHoldsTheLatest) {
  PictureQueue queue(1);
  for (int k = 0; k < 5; ++k) queue.put(picture(k));
  const auto taken = queue.take(0);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->captured_s, 4);
  EXPECT_EQ(taken->lost, 4);
  EXPECT_EQ(queue.dropped(), 4);
  EXPECT_FALSE(queue.take(0));
}

TEST(PictureQueue, GivesInOrderAndAccountsForEveryPicture) {
  PictureQueue queue(3);
  std::int64_t put = 0;
  std::int64_t seen = 0;
  double last = -1;
  for (int k = 0; k < 100; ++k) {
    queue.put(picture(k, k % 7 == 0 ? 2 : 0));  // the driver lost two before every seventh
    put += 1 + (k % 7 == 0 ? 2 : 0);
    if (k % 5 != 4) continue;  // two of five are let go
    while (const auto taken = queue.take(0)) {
      EXPECT_GT(taken->captured_s, last);
      last = taken->captured_s;
      seen += 1 + taken->lost;
    }
  }
  EXPECT_EQ(seen, put);
  EXPECT_EQ(queue.dropped(), 40);
}

TEST(PictureQueue, WakesWhoWaits) {
  PictureQueue queue(1);
  std::thread camera([&] { queue.put(picture(7)); });
  const auto taken = queue.take(10);
  camera.join();
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->captured_s, 7);
}

TEST(PictureQueue, WantsRoom) { EXPECT_THROW(PictureQueue(0), std::invalid_argument); }

}  // namespace
}  // namespace kestrel
