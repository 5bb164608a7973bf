#include "kestrel/io/yaml_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string error_of(const std::string& text) {
  return test::message_of([&] { parse_yaml("t.yaml", text); });
}

TEST(ParseYaml, KeepsKindsLinesAndQuotes) {
  const YamlNode tree = parse_yaml("t.yaml", "a: 1\nb: 'x'\n\nc:\n  - 2\n  - [3]\nd:\n");
  ASSERT_EQ(tree.entries.size(), 4u);
  EXPECT_TRUE(tree.find("a")->value.is_plain);
  EXPECT_EQ(tree.find("a")->value.scalar, "1");
  EXPECT_FALSE(tree.find("b")->value.is_plain);
  EXPECT_EQ(tree.find("c")->line, 4);
  EXPECT_EQ(tree.find("c")->value.list[1].line, 6);
  EXPECT_EQ(tree.find("c")->value.list[1].kind, YamlNode::Kind::List);
  EXPECT_EQ(tree.find("d")->value.kind, YamlNode::Kind::Empty);
  EXPECT_EQ(tree.find("e"), nullptr);
}

TEST(ParseYaml, ReadsOpenCvsDirectiveTagsAndAliases) {
  const YamlNode tree =
      parse_yaml("t.yaml", "%YAML:1.0\n---\nm: !!opencv-matrix\n   rows: 1\nn: &x 2\no: *x\n");
  EXPECT_EQ(tree.find("m")->value.find("rows")->value.scalar, "1");
  EXPECT_EQ(tree.find("o")->value.scalar, "2");
}

TEST(ParseYaml, RefusesDuplicateKeysAtAnyDepth) {
  EXPECT_EQ(error_of("a: 1\nb: 2\na: 3\n"), "t.yaml:3: a: is given twice; remove one of the two");
  EXPECT_THAT(error_of("s:\n  t:\n    x: 1\n    x: 1\n"),
              StartsWith("t.yaml:4: s.t.x: is given twice"));
}

TEST(ParseYaml, RefusesTextsThatAreNoMapOfKeys) {
  EXPECT_THAT(error_of(""), HasSubstr("t.yaml: is empty"));
  EXPECT_THAT(error_of("# only a comment\n\n"), HasSubstr("is empty"));
  EXPECT_THAT(error_of("- a\n- b\n"), HasSubstr("the file is a list"));
  EXPECT_THAT(error_of("just words\n"), HasSubstr("the file is a text"));
  EXPECT_THAT(error_of("? [a, b]\n: 1\n"), HasSubstr("single word"));
}

TEST(ParseYaml, RefusesWhatIsNoYaml) {
  EXPECT_THAT(error_of("a: 1\nb: [1, 2\n"), HasSubstr("is no YAML"));
  EXPECT_THAT(error_of("a:\n\tb: 1\n"), AllOf(StartsWith("t.yaml:2: "), HasSubstr("spaces")));
  EXPECT_THAT(error_of("\x01\x02\xff\xfe"), HasSubstr("t.yaml"));
  EXPECT_THAT(error_of(std::string(20000, '[')), HasSubstr("is no YAML"));
}

// yaml-cpp alone would drop the rest of such a file in silence.
TEST(ParseYaml, RefusesAnythingAfterTheFirstDocument) {
  EXPECT_THAT(error_of("a: 1\n---\nb: 2\n"), StartsWith("t.yaml:2: begins a second document"));
  EXPECT_THAT(error_of("{a: 1}\n}\nb: 2\n"), StartsWith("t.yaml:2: "));
}

TEST(ParseYaml, RefusesAliasesThatMultiply) {
  std::string text = "a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before + "," + before +
            "," + before + "," + before + "," + before + "]\n";
  }
  EXPECT_THAT(error_of(text), HasSubstr("too many values"));
}

TEST(ParseYaml, AnswersAnyTextWithATreeOrAFileError) {
  test::Random random("yaml junk");
  const std::string alphabet = "ab:{}[],-#&*!|>'\"%@`?\n\n  \t0.~<\xff\x01";
  int trees = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text;
    const int length = random.integer(0, 40);
    for (int k = 0; k < length; ++k) {
      text += alphabet[std::size_t(random.integer(0, int(alphabet.size()) - 1))];
    }
    try {
      parse_yaml("t.yaml", text);
      ++trees;
    } catch (const FileError&) {
    }
  }
  EXPECT_LT(trees, 3000);
}

}  // namespace
}  // namespace kestrel
