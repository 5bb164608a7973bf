#include "kestrel/ground/request_guard.hpp"

#include <string>

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(RequestGuard, HostsAreNumbersOrLocalhost) {
  EXPECT_EQ(plain_host("127.0.0.1:8080"), "127.0.0.1");
  EXPECT_EQ(plain_host("127.0.0.1"), "127.0.0.1");
  EXPECT_EQ(plain_host("localhost:1"), "localhost");
  EXPECT_EQ(plain_host("[::1]:8080"), "[::1]");
  for (const char* bad : {"", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil",
                          "127.0.0.1:80x", "127.0.0.1:", "[::1", "::1:80", "1.2.3.4; x", "[]:1"}) {
    EXPECT_EQ(plain_host(bad), "") << bad;
  }
  EXPECT_EQ(plain_host(std::string(1000, '1')), "");
}

TEST(RequestGuard, OnlyThePageItselfMayCommand) {
  EXPECT_TRUE(is_own_origin("http://127.0.0.1:8080", "127.0.0.1:8081", 8080));
  EXPECT_TRUE(is_own_origin("http://[::1]:8080", "[::1]:8081", 8080));
  EXPECT_TRUE(is_own_origin("http://10.0.0.2", "10.0.0.2:81", 80));
  EXPECT_FALSE(is_own_origin("http://127.0.0.1:8082", "127.0.0.1:8081", 8080)) << "another program";
  EXPECT_FALSE(is_own_origin("http://evil.example:8080", "127.0.0.1:8081", 8080));
  EXPECT_FALSE(is_own_origin("http://evil.example:8080", "evil.example:8081", 8080)) << "rebound";
  EXPECT_FALSE(is_own_origin("https://127.0.0.1:8080", "127.0.0.1:8081", 8080));
  EXPECT_FALSE(is_own_origin("http://127.0.0.1:8080.evil.example", "127.0.0.1:8081", 8080));
  EXPECT_FALSE(is_own_origin("null", "127.0.0.1:8081", 8080));
  EXPECT_FALSE(is_own_origin("", "127.0.0.1:8081", 8080));
}

TEST(RequestGuard, APageOverTlsIsAnotherThanOneWithout) {
  EXPECT_TRUE(is_own_origin("https://127.0.0.1:8080", "127.0.0.1:8081", 8080, "https"));
  EXPECT_TRUE(is_own_origin("https://10.0.0.2", "10.0.0.2:444", 443, "https"));
  EXPECT_FALSE(is_own_origin("https://10.0.0.2", "10.0.0.2:444", 80, "https"));
  EXPECT_FALSE(is_own_origin("http://127.0.0.1:8080", "127.0.0.1:8081", 8080, "https"));
}

TEST(RequestGuard, OnlyThisMachineReachesALoopbackAddress) {
  for (const char* own : {"127.0.0.1", "127.1.2.3", "::1", "localhost"}) {
    EXPECT_TRUE(is_loopback(own)) << own;
  }
  for (const char* other : {"0.0.0.0", "::", "10.0.0.2", "192.168.127.1", "127.evil.example", "",
                            "localhost.example"}) {
    EXPECT_FALSE(is_loopback(other)) << other;
  }
}

}  // namespace
}  // namespace kestrel
