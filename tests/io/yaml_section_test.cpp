#include "kestrel/io/yaml_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class SectionTest : public ::testing::Test {
 protected:
  Section load(const std::string& text) { return Section::load(folder_.write("t.yaml", text)); }
  /// What an error of line n looks like from its beginning.
  std::string at(int line, const std::string& rest) const {
    return (folder_.path() / "t.yaml").string() + ":" + std::to_string(line) + ": " + rest;
  }
  test::TempFolder folder_;
};

TEST_F(SectionTest, ReadsATextThatIsInNoFile) {
  const Section s = Section::parse("--set", "track: {ratio: 0.7, other: 1}\n");
  EXPECT_EQ(s.child("track").number("ratio"), 0.7);
  EXPECT_THAT(message_of([&] { s.done(); }), StartsWith("--set:1: track.other: "));
}

TEST_F(SectionTest, ReadsEveryKindOfValue) {
  const Section s = load(
      "number: -1.5e-3\nwhole: 42\nword: mean\nquoted: \"12\"\non: true\noff: false\n"
      "list: [1, 2.5, -3]\nrows: [[1, 2], [3, 4]]\nfile: ../calib/a.xml\nsub: {deep: {x: 7}}\n");
  EXPECT_EQ(s.number("number"), -1.5e-3);
  EXPECT_EQ(s.integer("whole"), 42);
  EXPECT_EQ(s.text("word"), "mean");
  EXPECT_EQ(s.text("quoted"), "12");
  EXPECT_TRUE(s.flag("on", false));
  EXPECT_FALSE(s.flag("off", true));
  EXPECT_EQ(s.numbers("list", 3), (std::vector<double>{1, 2.5, -3}));
  EXPECT_EQ(s.numbers("rows", 4), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(s.path("file"), folder_.path().parent_path() / "calib/a.xml");
  EXPECT_EQ(s.child("sub").child("deep").integer("x"), 7);
  EXPECT_NO_THROW(s.done());
}

TEST_F(SectionTest, UsesDefaultsForAbsentKeysOnly) {
  const Section s = load("a: 1\n");
  EXPECT_EQ(s.number("a", 5), 1);
  EXPECT_EQ(s.number("b", 5), 5);
  EXPECT_EQ(s.integer("b", -9), -9);
  EXPECT_EQ(s.whole("a", 3), 1);
  EXPECT_EQ(s.text("b", "t"), "t");
  EXPECT_TRUE(s.flag("b", true));
  EXPECT_FALSE(s.child_if("b").has_value());
  EXPECT_NO_THROW(s.done());
}

TEST_F(SectionTest, ChoosesAmongWords) {
  enum class Side { Left, Right, Both };
  const std::vector<std::pair<std::string, Side>> words = {
      {"left", Side::Left}, {"right", Side::Right}, {"both", Side::Both}};
  const Section s = load("a: right\nb: up\n");
  EXPECT_EQ(s.choice("a", words), Side::Right);
  EXPECT_EQ(s.choice("c", words, Side::Both), Side::Both);
  EXPECT_EQ(message_of([&] { s.choice("b", words); }),
            at(2, "b: is 'up'; write left, right or both"));
}

TEST_F(SectionTest, NamesTheLineOfAMissingKey) {
  const Section s = load("a: 1\nservo:\n  freedom: 1\n  gian_per_s: 2\n");
  EXPECT_EQ(message_of([&] { s.number("b"); }), at(1, "b: is missing; add it"));
  EXPECT_EQ(message_of([&] { s.child("servo").number("gain_per_s"); }),
            at(2, "servo.gain_per_s: is missing; did you mean it by gian_per_s?"));
}

TEST_F(SectionTest, RefusesUnknownKeysEverywhereAndNamesTheNearest) {
  const Section s = load("a: 1\nservo:\n  gain_per_s: 1\n  freedon: four\n");
  s.number("a");
  const Section servo = s.child("servo");
  servo.number("gain_per_s");
  servo.text("freedom", "four");
  EXPECT_EQ(message_of([&] { s.done(); }),
            at(4, "servo.freedon: is no key here; did you mean freedom?"));
  const Section t = load("a: 1\nzebra: {b: 1}\n");
  t.number("a");
  EXPECT_EQ(message_of([&] { t.done(); }), at(2, "zebra: is no key here; remove it"));
}

TEST_F(SectionTest, RefusesAKeyThatWasOnlyLookedFor) {
  const Section s = load("a: 1\nb: 2\n");
  s.number("a");
  EXPECT_TRUE(s.has("b"));
  EXPECT_THAT(message_of([&] { s.done(); }), StartsWith(at(2, "b: has no effect")));
}

TEST_F(SectionTest, SharesWhatWasReadBetweenCopiesOfAChild) {
  const Section s = load("sub: {a: 1, b: 2}\n");
  s.child("sub").number("a");
  s.child("sub").number("b");
  EXPECT_NO_THROW(s.done());
}

TEST_F(SectionTest, RefusesNumbersThatAreNone) {
  const Section s =
      load("a: .nan\nb: -.inf\nc: 010\nd: '12'\ne: yes\nf:\ng: [1]\nh: {x: 1}\ni: ~\nj: 1e400\n");
  EXPECT_THAT(message_of([&] { s.number("a"); }), StartsWith(at(1, "a: '.nan' is not finite")));
  EXPECT_THAT(message_of([&] { s.number("b"); }), StartsWith(at(2, "b: '-.inf' is not finite")));
  EXPECT_THAT(message_of([&] { s.number("c"); }),
              AllOf(StartsWith(at(3, "c: ")), HasSubstr("octal")));
  EXPECT_THAT(message_of([&] { s.integer("c"); }), HasSubstr("octal"));
  EXPECT_THAT(message_of([&] { s.number("d"); }), EndsWith("remove the quotes"));
  EXPECT_THAT(message_of([&] { s.number("e"); }), HasSubstr("'yes' is not a number"));
  EXPECT_THAT(message_of([&] { s.number("f"); }), StartsWith(at(6, "f: has no value")));
  EXPECT_THAT(message_of([&] { s.number("g"); }), HasSubstr("is a list; give a number"));
  EXPECT_THAT(message_of([&] { s.number("h"); }), HasSubstr("is a section of keys"));
  EXPECT_THAT(message_of([&] { s.number("i", 3); }), HasSubstr("has no value"));
  EXPECT_THAT(message_of([&] { s.number("j"); }), StartsWith(at(10, "j: ")));
}

TEST_F(SectionTest, RefusesWholeNumbersThatAreNone) {
  const Section s =
      load("a: 3.0\nb: 1e3\nc: 9223372036854775807\nd: 9223372036854775808\ne: 3000000000\n");
  EXPECT_THAT(message_of([&] { s.integer("a"); }), StartsWith(at(1, "a: '3.0' is not a whole")));
  EXPECT_THAT(message_of([&] { s.integer("b"); }), StartsWith(at(2, "b: '1e3' is not a whole")));
  EXPECT_EQ(s.integer("c"), std::numeric_limits<std::int64_t>::max());
  EXPECT_THAT(message_of([&] { s.integer("d"); }), HasSubstr("is not a whole number"));
  EXPECT_EQ(s.integer("e"), 3000000000);
  EXPECT_THAT(message_of([&] { s.whole("e", 0); }),
              StartsWith(at(5, "e: 3000000000 is too large")));
}

TEST_F(SectionTest, RefusesFlagsAndTextsThatAreNone) {
  const Section s = load("a: yes\nb: 'true'\nc: ''\nd: [x]\ne: 1\n");
  EXPECT_EQ(message_of([&] { s.flag("a", false); }), at(1, "a: is 'yes'; write true or false"));
  EXPECT_THAT(message_of([&] { s.flag("b", false); }), HasSubstr("remove the quotes"));
  EXPECT_THAT(message_of([&] { s.flag("e", false); }), HasSubstr("write true or false"));
  EXPECT_THAT(message_of([&] { s.text("c"); }), HasSubstr("empty text"));
  EXPECT_THAT(message_of([&] { s.text("d"); }), HasSubstr("is a list; give a text"));
}

TEST_F(SectionTest, RefusesListsOfTheWrongLengthOrKind) {
  const Section s = load("a: [1, 2]\nb:\n  - 1\n  - x\nc: 5\nd: [[[1]]]\n");
  EXPECT_EQ(message_of([&] { s.numbers("a", 3); }), at(1, "a: has 2 numbers; give 3"));
  EXPECT_THAT(message_of([&] { s.numbers("b", 2); }), StartsWith(at(4, "b: 'x' is not a number")));
  EXPECT_THAT(message_of([&] { s.numbers("c"); }), HasSubstr("give a list"));
  EXPECT_THAT(message_of([&] { s.numbers("d"); }), HasSubstr("give a list"));
  EXPECT_THAT(message_of([&] { s.child("c"); }),
              StartsWith(at(5, "c: is a text or number; write keys")));
}

TEST_F(SectionTest, ReadsListsOfWordsAndOfKeys) {
  const Section s = load("a:\n  - cur\n  - {law: mean, gain: 2}\nb: all\nc: [x, y]\n");
  const auto items = s.items("a");
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0].word, "cur");
  EXPECT_FALSE(items[0].keys);
  ASSERT_TRUE(items[1].keys);
  EXPECT_EQ(items[1].keys->text("law"), "mean");
  EXPECT_EQ(items[1].keys->keys(), (std::vector<std::string>{"law", "gain"}));
  EXPECT_EQ(s.words("b"), std::vector<std::string>{"all"});
  EXPECT_EQ(s.words("c"), (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(message_of([&] { s.done(); }), at(3, "a[2].gain: is no key here; remove it"));
  EXPECT_EQ(items[1].keys->number("gain"), 2);
  s.done();
}

TEST_F(SectionTest, RefusesItemsOfTheWrongKind) {
  const Section s = load("a: [[1]]\nb: {c: 1}\nd: [{e: 1}]\nf: ['']\n");
  EXPECT_THAT(message_of([&] { s.items("a"); }), StartsWith(at(1, "a[1]: is a list; give")));
  EXPECT_THAT(message_of([&] { s.items("b"); }), HasSubstr("give a list"));
  EXPECT_THAT(message_of([&] { s.words("d"); }), StartsWith(at(3, "d: has keys where words")));
  EXPECT_THAT(message_of([&] { s.words("f"); }), HasSubstr("empty text"));
}

TEST_F(SectionTest, NamesTheFileThatCannotBeLoaded) {
  EXPECT_THAT(message_of([&] { Section::load(folder_.path() / "none.yaml"); }),
              HasSubstr("none.yaml: there is no such file"));
  EXPECT_THAT(message_of([&] { Section::load(folder_.path()); }), HasSubstr("is a folder"));
  EXPECT_THAT(message_of([&] { load("a: 1\nb: 2\na: 3\n"); }), StartsWith(at(3, "a: is given")));
}

TEST_F(SectionTest, FailsAtTheLineOfAKeyOrOfTheSection) {
  const Section s = load("a: 1\nsub:\n  b: 2\n");
  EXPECT_EQ(message_of([&] { s.child("sub").fail("b", "is wrong; right it"); }),
            at(3, "sub.b: is wrong; right it"));
  EXPECT_EQ(message_of([&] { s.child("sub").fail("", "is wrong"); }), at(2, "sub: is wrong"));
}

TEST_F(SectionTest, ReadsWindowsLineEnds) {
  EXPECT_EQ(load("a: 1\r\nb: two\r\n").text("b"), "two");
}

}  // namespace
}  // namespace kestrel
