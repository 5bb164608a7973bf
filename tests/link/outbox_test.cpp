#include "kestrel/link/outbox.hpp"

#include <gtest/gtest.h>

#include "kestrel/link/signature_checker.hpp"

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

using mavlink::FrameView;
using test::Buffer;

const mavlink::SigningKey kKey({1, 2, 3});
const mavlink::SigningKey kOtherKey({4, 5, 6});
constexpr double kNow_s = 1.7e9;

FrameView view(const Delivery& delivery) {
  return std::get<FrameView>(mavlink::parse(delivery.bytes).content);
}

TEST(Outbox, KeepsEachFrameUntilTheNextStart) {
  test::Random random("outbox");
  Outbox outbox({});
  for (int round = 0; round < 5; ++round) {
    outbox.start(kNow_s);
    std::vector<Buffer> sent;
    for (int i = 0; i < 300; ++i) {
      sent.push_back(test::random_frame(random));
      outbox.forward(std::get<FrameView>(mavlink::parse(test::view(sent.back())).content),
                     {PeerId(i), 0, nullptr});
    }
    ASSERT_EQ(outbox.deliveries().size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
      EXPECT_EQ(outbox.deliveries()[i].to, i);
      EXPECT_EQ(test::copy(outbox.deliveries()[i].bytes), sent[i]);
    }
  }
  outbox.start(kNow_s);
  EXPECT_TRUE(outbox.deliveries().empty());
}

TEST(Outbox, SignsForLinksWithAKeyAndTakesForeignSignaturesOff) {
  Outbox outbox({});
  const auto signed_by_other =
      mavlink::signed_frame(mavlink::Heartbeat{}, {1, 191, 7}, {9, 1234}, kOtherKey);
  const auto frame = std::get<FrameView>(mavlink::parse(signed_by_other.bytes()).content);
  outbox.start(kNow_s);
  outbox.forward(frame, {1, 3, &kKey});
  outbox.forward(frame, {2, 3, nullptr});
  outbox.post(mavlink::Heartbeat{}, {1, 192, 0}, {3, 4, &kKey});
  const auto& sent = outbox.deliveries();
  EXPECT_TRUE(mavlink::signature_matches(view(sent[0]), kKey));
  EXPECT_EQ(mavlink::signing_stamp(view(sent[0])).link_id, 3);
  EXPECT_FALSE(view(sent[1]).is_signed());
  EXPECT_EQ(test::copy(sent[1].bytes),
            test::copy(mavlink::encode(mavlink::Heartbeat{}, {1, 191, 7}).bytes()));
  EXPECT_TRUE(mavlink::signature_matches(view(sent[2]), kKey));
}

TEST(Outbox, SignsSoThatAReceiverAcceptsEachFrameEvenWhenTheClockGoesBack) {
  Outbox outbox({});
  mavlink::SignatureChecker checker(kKey);
  for (const double unix_s : {kNow_s, kNow_s, kNow_s - 20, kNow_s - 20, kNow_s + 1}) {
    outbox.start(unix_s);
    outbox.post(mavlink::Heartbeat{}, {1, 192, 0}, {3, 0, &kKey});
    EXPECT_EQ(checker.check(view(outbox.deliveries()[0]), kNow_s), mavlink::Verdict::Genuine);
  }
}

TEST(Outbox, TakesItsTimesFromWhoKeepsThemAndGoesOnWithout) {
  std::optional<std::uint64_t> given = 5000;
  Outbox outbox([&](double) { return given; });
  const auto time = [&] {
    outbox.start(0);
    outbox.post(mavlink::Heartbeat{}, {1, 192, 0}, {3, 0, &kKey});
    return mavlink::signing_stamp(view(outbox.deliveries()[0])).time;
  };
  EXPECT_EQ(time(), 5000u);
  given.reset();
  EXPECT_EQ(time(), 5001u);
}

}  // namespace
}  // namespace kestrel
