#include "kestrel/link/message.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel::mavlink {
namespace {

using test::Buffer;

TEST(Message, OfEachKindKeepsEveryBit) {
  test::Random random("every message");
  for (const MessageInfo& info : message_infos()) {
    for (int i = 0; i < 100; ++i) {
      const Buffer payload = test::random_payload(info, random);
      const auto message = message_of(info.id, test::view(payload));
      ASSERT_TRUE(message.has_value()) << info.name;
      EXPECT_EQ(info_of(*message).id, info.id);
      EXPECT_EQ(test::fields(*message), payload) << info.name;
    }
  }
}

TEST(Message, IsSentWithoutTrailingZeros) {
  test::Random random("trimmed payloads");
  for (const MessageInfo& info : message_infos()) {
    const Payload payload = payload_of(test::random_message(info, random));
    EXPECT_TRUE(payload.size == 1 || payload.data[payload.size - 1] != 0) << info.name;
    EXPECT_EQ(payload_of(*message_of(info.id, {})).size, 1u) << info.name;
  }
}

TEST(Message, ReadsWhatIsMissingAsZeroAndPassesOverWhatIsNew) {
  test::Random random("lengths");
  for (const MessageInfo& info : message_infos()) {
    const Buffer whole = test::random_payload(info, random);
    for (std::size_t size = 0; size <= kMaxPayload; ++size) {
      Buffer sent = whole;
      sent.resize(size, 0xAA);
      Buffer expected(whole.begin(), whole.begin() + std::ptrdiff_t(std::min(size, whole.size())));
      expected.resize(info.longest);
      EXPECT_EQ(test::fields(*message_of(info.id, test::view(sent))), expected) << info.name;
    }
  }
}

TEST(Message, ThatIsNotKnownIsNone) { EXPECT_FALSE(message_of(86, {}).has_value()); }

}  // namespace
}  // namespace kestrel::mavlink
