#include "kestrel/io/csv.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string message(const std::filesystem::path& path) {
  try {
    LineFile(path).write("line");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Number, ComesBackToTheLastBit) {
  test::Random random("number");
  for (int i = 0; i < 5000; ++i) {
    const double value = random.normal() * std::pow(10, random.integer(-300, 300));
    const double back = csv_number(number(value)).value();
    EXPECT_EQ(std::memcmp(&value, &back, sizeof value), 0) << number(value);
  }
  for (const double value : {0., -0., 5e-324, std::numeric_limits<double>::max()})
    EXPECT_EQ(std::signbit(value), std::signbit(csv_number(number(value)).value()));
  EXPECT_TRUE(std::isnan(csv_number(number(std::nan(""))).value()));
  EXPECT_TRUE(std::isinf(csv_number("-inf").value()));
}

TEST(Number, IsNothingElse) {
  for (const char* text : {"", " 1", "1 ", "1,5", "0x10", "1e", "one", "+"})
    EXPECT_FALSE(csv_number(text)) << text;
}

TEST(CsvFields, AreOneMoreThanCommas) {
  EXPECT_EQ(csv_fields("").size(), 1u);
  EXPECT_EQ(csv_fields("a,,b,"), (std::vector<std::string_view>{"a", "", "b", ""}));
}

TEST(LineFile, HasEachLineOnceWritten) {
  const test::TempFolder folder;
  LineFile file(folder / "a.csv");
  file.write("one");
  EXPECT_EQ(content(folder / "a.csv"), "one\n");  // the file is still open
  file.write("two");
  EXPECT_EQ(content(folder / "a.csv"), "one\ntwo\n");
}

TEST(LineFile, TellsPathCauseAndRemedy) {
  EXPECT_THAT(message("/dev/full"),
              AllOf(HasSubstr("/dev/full"), HasSubstr("No space left"), HasSubstr("free some")));
  const test::TempFolder folder;
  EXPECT_THAT(message(folder / "missing/a.csv"),
              AllOf(HasSubstr("missing/a.csv"), HasSubstr("create its folder")));
  EXPECT_THAT(message(folder.path()), HasSubstr("give the name of a file"));
}

TEST(WriteText, WritesAllOrThrows) {
  const test::TempFolder folder;
  const std::string text(100000, 'x');
  write_text(folder / "a.txt", text);
  EXPECT_EQ(content(folder / "a.txt"), text);
  EXPECT_THROW(write_text("/dev/full", text), std::runtime_error);
  EXPECT_THROW(write_text("/dev/full", "short"), std::runtime_error);
}

}  // namespace
}  // namespace kestrel
