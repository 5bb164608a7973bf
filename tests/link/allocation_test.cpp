// Nothing is allocated while frames are read, written, signed and checked.
#include <vector>

#include <gtest/gtest.h>

#include "kestrel/link/signature_checker.hpp"
#include "kestrel/link/stream_parser.hpp"
#include "kestrel/link/timestamp_store.hpp"

#include "samples.hpp"
#include "support/allocations.hpp"
#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::mavlink {
namespace {

using test::allocations;

constexpr double kNow_s = 1.8e9;

TEST(LinkAllocation, IsCounted) {
  const int before = allocations;
  const std::vector<int> numbers(50, 1);
  EXPECT_GT(allocations, before) << numbers.size();
}

TEST(LinkAllocation, ThereIsNoneFromSendingToObeying) {
  const test::TempFolder folder(test::memory_folder());
  const SigningKey key = random_key();
  SignatureChecker checker(key);
  StreamParser stream;
  TimestampStore times(folder / "times");
  ASSERT_TRUE(times.extend(kNow_s));
  const int before = allocations;
  int genuine = 0, streamed = 0;
  for (int i = 0; i < 1000; ++i) {
    const double now_s = kNow_s + 0.01 * i;
    const EncodedFrame frame =
        signed_frame(SetPositionTarget{}, {1, 191, std::uint8_t(i)}, {0, *times.next(now_s)}, key);
    const Parsed parsed = parse(frame.bytes());
    genuine += checker.check(std::get<FrameView>(parsed.content), now_s) == Verdict::Genuine;
    (void)unsigned_frame(std::get<FrameView>(parsed.content));
    stream.push(frame.bytes());
    while (stream.next()) ++streamed;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(genuine, 1000);
  EXPECT_EQ(streamed, 1000);
}

TEST(LinkAllocation, ThereIsNoneForAnyMessageOrGarbage) {
  test::Random random("allocation of all");
  std::vector<Message> messages;
  for (const MessageInfo& info : message_infos()) {
    messages.push_back(test::random_message(info, random));
  }
  test::Buffer garbage(5000);
  for (std::uint8_t& byte : garbage) byte = random.integer(0, 5) == 0 ? kMagic : 7;
  StreamParser stream;
  const int before = allocations;
  std::size_t read = 0;
  for (const Message& message : messages) read += decode(encode(message, {}).bytes()).size;
  for (Bytes rest = test::view(garbage); rest.size > 0; rest = rest.after(parse(rest).size)) {
  }
  for (Bytes rest = test::view(garbage); rest.size > 0;) {
    rest = stream.push(rest);
    while (stream.next()) {
    }
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(read, messages.size() * kHeaderSize);
}

}  // namespace
}  // namespace kestrel::mavlink
