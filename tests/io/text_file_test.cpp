#include "kestrel/io/text_file.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "kestrel/io/yaml_section.hpp"

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(FileError, SaysFileLineKeyAndWhat) {
  EXPECT_STREQ(FileError("a/b.yaml", 7, "servo.gain_per_s", "is missing; add it").what(),
               "a/b.yaml:7: servo.gain_per_s: is missing; add it");
  EXPECT_STREQ(FileError("b.yaml", 0, "", "is empty").what(), "b.yaml: is empty");
}

TEST(ReadText, ReturnsTheBytesWithoutAByteOrderMark) {
  const test::TempFolder folder;
  EXPECT_EQ(read_text(folder.write("a", "one\r\ntwo")), "one\r\ntwo");
  EXPECT_EQ(read_text(folder.write("b", "\xEF\xBB\xBFone")), "one");
  EXPECT_EQ(read_text(folder.write("c", "")), "");
}

TEST(ReadText, NamesTheNearestFileForAMissingOne) {
  const test::TempFolder folder;
  folder.write("camera.xml", "");
  const auto missing = folder.path() / "camra.xml";
  EXPECT_EQ(message_of([&] { read_text(missing); }),
            missing.string() + ": there is no such file; did you mean camera.xml?");
  EXPECT_THAT(message_of([&] { read_text(folder.path() / "zzzzzz"); }),
              EndsWith("there is no such file; correct the path"));
  EXPECT_THAT(message_of([&] { read_text(folder.path() / "none" / "x.yaml"); }),
              AllOf(HasSubstr("the folder"), HasSubstr("does not exist")));
}

TEST(ReadText, RefusesWhatIsNoReadableText) {
  const test::TempFolder folder;
  EXPECT_THAT(message_of([&] { read_text(folder.path()); }), HasSubstr("is a folder, not a file"));
  EXPECT_THAT(message_of([] { read_text(""); }), HasSubstr("name a file"));
  const auto binary = folder.write("junk", std::string("a\nb\0c", 5));
  EXPECT_THAT(message_of([&] { read_text(binary); }),
              StartsWith(binary.string() + ":2: is no text"));
  const auto large = folder.write("large", "");
  std::filesystem::resize_file(large, (16u << 20) + 1);
  EXPECT_THAT(message_of([&] { read_text(large); }), HasSubstr("larger than 16 MB"));
}

TEST(ReadText, NamesPermissionsAsTheCause) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads everything";
  const test::TempFolder folder;
  const auto secret = folder.write("secret", "x");
  chmod(secret.c_str(), 0);
  EXPECT_THAT(message_of([&] { read_text(secret); }), HasSubstr("permissions"));
}

TEST(ParseNumber, InvertsPrintingToTheBit) {
  test::Random random("parse_number");
  for (int i = 0; i < 200; ++i) {
    const double number = random.normal() * std::pow(10, random.integer(-12, 12));
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", number);
    EXPECT_EQ(parse_number(text), number) << text;
  }
  EXPECT_EQ(parse_number("+1.5"), 1.5);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  EXPECT_EQ(parse_number("0"), 0);
  EXPECT_EQ(parse_number("0.1"), 0.1);
  EXPECT_EQ(parse_number("3."), 3);
}

TEST(ParseNumber, RefusesWhatIsNotOnePlainFiniteNumber) {
  for (const char* text : {"", "x", "1x", "1 2", "0x10", "1_000", "1,5", "--1", "+-1", "-", ".",
                           "e5", "1e", "~", "1e999"}) {
    EXPECT_THROW(parse_number(text), std::invalid_argument) << text;
  }
  for (const char* text : {".nan", ".NaN", "nan", ".inf", "-.inf", "inf", "-Infinity"}) {
    EXPECT_THAT(message_of([&] { parse_number(text); }), HasSubstr("not finite")) << text;
  }
  EXPECT_THAT(message_of([] { parse_number("010"); }), HasSubstr("octal"));
  EXPECT_THAT(message_of([] { parse_number("-007.5"); }), HasSubstr("octal"));
}

TEST(NearestWord, FindsSlipsAndBeginningsOnly) {
  const std::vector<std::string> known = {"gain_per_s", "interaction", "freedom"};
  EXPECT_EQ(nearest_word("gian_per_s", known), "gain_per_s");
  EXPECT_EQ(nearest_word("gain", known), "gain_per_s");
  EXPECT_EQ(nearest_word("interactions", known), "interaction");
  EXPECT_EQ(nearest_word("colour", known), "");
  EXPECT_EQ(nearest_word("x", {}), "");
}

TEST(YamlQuoted, IsReadBackAsItWas) {
  const test::TempFolder folder;
  for (const std::string text : {"plain", "a 'box': red", "say \"hi\" # no comment", "C:\\x\\n",
                                 "- [1, 2]", "null", "{a: b}"}) {
    folder.write("t.yaml", "a: " + yaml_quoted(text) + "\n");
    EXPECT_EQ(Section::load(folder / "t.yaml").text("a"), text);
  }
  EXPECT_EQ(yaml_quoted("two\nlines"), "\"two lines\"");
}

}  // namespace
}  // namespace kestrel
