#include "kestrel/link/link_place.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using testing::HasSubstr;

TEST(LinkPlace, TheSchemeSaysWhoBegins) {
  EXPECT_EQ(parse_link_place("udp://127.0.0.1:1").kind, LinkKind::UdpClient);
  EXPECT_EQ(parse_link_place("udp-listen://127.0.0.1:1").kind, LinkKind::UdpServer);
  EXPECT_EQ(parse_link_place("tcp://127.0.0.1:1").kind, LinkKind::TcpClient);
  EXPECT_EQ(parse_link_place("tcp-listen://127.0.0.1:1").kind, LinkKind::TcpServer);
  EXPECT_FALSE(is_stream(LinkKind::UdpServer));
  EXPECT_TRUE(is_stream(LinkKind::TcpClient));
  EXPECT_TRUE(is_server(LinkKind::UdpServer));
  EXPECT_FALSE(is_server(LinkKind::TcpClient));
}

TEST(LinkPlace, IsWrittenAsItIsRead) {
  for (const char* text : {"udp://127.0.0.1:14550", "udp-listen://0.0.0.0:0", "tcp://[::1]:5760",
                           "tcp-listen://[::]:5760"}) {
    EXPECT_EQ(to_string(parse_link_place(text)), text);
  }
}

TEST(LinkPlace, SaysWhatIsWrong) {
  const auto why = [](const char* text) {
    return test::message_of([&] { parse_link_place(text); });
  };
  for (const char* text : {"", "127.0.0.1:5", "serial:///dev/ttyS0", "udp:/127.0.0.1:5"}) {
    EXPECT_THAT(why(text), HasSubstr("tcp-listen://")) << text;
  }
  EXPECT_THAT(why("tcp://heli.local:5760"), HasSubstr("names are not looked up"));
  EXPECT_THAT(why("tcp://127.0.0.1:0"), HasSubstr("nothing can be sent there"));
  EXPECT_THAT(why("udp://0.0.0.0:5"), HasSubstr("nothing can be sent there"));
}

}  // namespace
}  // namespace kestrel
