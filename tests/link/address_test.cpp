#include "kestrel/link/address.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kestrel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Address, IsReadAsItIsWritten) {
  for (const std::string text : {"udp://127.0.0.1:5005", "udp://0.0.0.0:0", "udp://[::1]:14550",
                                 "udp://[::]:65535", "udp://[2001:db8::7]:1"}) {
    EXPECT_EQ(to_string(parse_address(text)), text);
    EXPECT_EQ(parse_address(to_string(parse_address(text))), parse_address(text));
  }
}

TEST(Address, HasOneSpelling) {
  EXPECT_EQ(parse_address("udp://[0:0::0001]:5"), (Address{"::1", 5}));
  EXPECT_EQ(parse_address("udp://[2001:DB8::A]:5"), (Address{"2001:db8::a", 5}));
  EXPECT_EQ(parse_address("udp://localhost:5"), (Address{"127.0.0.1", 5}));
  EXPECT_EQ(parse_address("udp://10.0.0.1:0005"), (Address{"10.0.0.1", 5}));
}

TEST(Address, KnowsItsKind) {
  EXPECT_TRUE(parse_address("udp://[::1]:5").is_ipv6());
  EXPECT_FALSE(parse_address("udp://127.0.0.1:5").is_ipv6());
  EXPECT_TRUE(parse_address("udp://0.0.0.0:5").is_any());
  EXPECT_TRUE(parse_address("udp://[::]:5").is_any());
  EXPECT_FALSE(parse_address("udp://127.0.0.1:5").is_any());
}

TEST(Address, OrdersByHostThenPort) {
  EXPECT_LT((Address{"a", 2}), (Address{"b", 1}));
  EXPECT_LT((Address{"a", 1}), (Address{"a", 2}));
  EXPECT_NE((Address{"a", 1}), (Address{"a", 2}));
  EXPECT_NE((Address{"a", 1}), (Address{"b", 1}));
}

TEST(Address, SaysWhatIsWrongAndHowToWriteIt) {
  const std::pair<std::string, std::string> wrong[] = {
      {"", "does not start with udp://"},
      {"127.0.0.1:5005", "does not start with udp://"},
      {"tcp://127.0.0.1:5005", "does not start with udp://"},
      {"udp://", "port is missing"},
      {"udp://127.0.0.1", "port is missing"},
      {"udp://[::1]", "port is missing"},
      {"udp://[::1]5005", "port is missing"},
      {"udp://[::1:5005", "']' is missing"},
      {"udp://::1:5005", "needs brackets"},
      {"udp://127.0.0.1:", "must be a number"},
      {"udp://127.0.0.1:65536", "must be a number"},
      {"udp://127.0.0.1:-1", "must be a number"},
      {"udp://127.0.0.1:+5", "must be a number"},
      {"udp://127.0.0.1: 5", "must be a number"},
      {"udp://127.0.0.1:5005/", "must be a number"},
      {"udp://127.0.0.1:0x10", "must be a number"},
      {"udp://:5005", "not an IPv4 address"},
      {"udp://helicopter.local:5005", "names are not looked up"},
      {"udp://127.1:5005", "not an IPv4 address"},
      {"udp://127.0.0.256:5005", "not an IPv4 address"},
      {"udp://[127.0.0.1]:5005", "not an IPv6 address"},
      {"udp://[]:5005", "not an IPv6 address"},
      {"udp://[fe80::1%eth0]:5005", "not an IPv6 address"},
  };
  for (const auto& [text, why] : wrong) {
    const std::string& address = text;
    EXPECT_THAT([&] { parse_address(address); },
                ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr(why), HasSubstr("'" + text + "'"),
                          HasSubstr("write udp://127.0.0.1:5005 or udp://[::1]:5005"))))
        << text;
  }
}

TEST(Address, IsNotCutAtAZeroByte) {
  const std::string text("udp://127.0.0.1\0x:5005", 22);
  EXPECT_THROW(parse_address(text), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
