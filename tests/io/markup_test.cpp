#include "kestrel/io/markup.hpp"

#include <gtest/gtest.h>

#include "support/markup_check.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

TEST(Escaped, LeavesNoMarkup) {
  EXPECT_EQ(escaped("<a b=\"1\" c='2'>&"), "&lt;a b=&quot;1&quot; c=&#39;2&#39;&gt;&amp;");
  EXPECT_EQ(escaped("θ‖e‖ 😀\n"), "θ‖e‖ 😀\n");
}

TEST(Escaped, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(escaped("a\xff\x62\x01"), "a\uFFFDb");
  EXPECT_EQ(escaped("\xc0\x80"), "\uFFFD\uFFFD");            // overlong
  EXPECT_EQ(escaped("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // surrogate
  EXPECT_EQ(escaped("\xe2\x82"), "\uFFFD\uFFFD");            // cut short
}

TEST(Escaped, IsAlwaysSafeInsideAnElement) {
  test::Random random("escaped");
  for (int i = 0; i < 300; ++i) {
    std::string text;
    for (int k = 0; k < 40; ++k) text += char(random.integer(0, 255));
    EXPECT_EQ(test::markup_fault("<p a=\"" + escaped(text) + "\">" + escaped(text) + "</p>"), "");
  }
}

TEST(RelativeUrl, IsNeverAScheme) {
  EXPECT_EQ(relative_url("video.mp4"), "./video.mp4");
  EXPECT_EQ(relative_url("javascript:x"), "./javascript%3Ax");
  EXPECT_EQ(relative_url("a b#c?.mp4"), "./a%20b%23c%3F.mp4");
}

TEST(Base64, GivesTheVectorsOfRfc4648) {
  const auto of = [](const std::string& text) {
    return base64(std::vector<unsigned char>(text.begin(), text.end()));
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe\xfd"), "//79");
}

TEST(MarkupFault, FindsFaults) {
  for (const char* text :
       {"<a><b></a></b>", "<a>", "</a>", "<a b=\"<\"></a>", "a & b", "a > b", "<a b=\"1></a>"})
    EXPECT_NE(test::markup_fault(text), "") << text;
  EXPECT_EQ(test::markup_fault("<!DOCTYPE html><a><meta x=\"1\"><b c='>'/>&amp;</a>"), "");
}

}  // namespace
}  // namespace kestrel
