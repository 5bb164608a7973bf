#include "kestrel/io/image_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ImageFiles : public ::testing::Test {
 protected:
  std::string pattern(const std::string& name) const { return (folder_.path() / name).string(); }
  static std::vector<std::int64_t> numbers(const NumberedFiles& files) {
    std::vector<std::int64_t> list;
    for (const auto& [number, file] : files) list.push_back(number);
    return list;
  }
  static std::vector<std::string> names(const NumberedFiles& files) {
    std::vector<std::string> list;
    for (const auto& [number, file] : files) list.push_back(file.filename().string());
    return list;
  }
  test::TempFolder folder_;
};

TEST_F(ImageFiles, FindsTheNumbersOfAPattern) {
  for (const char* name : {"i0001.png", "i0010.png", "i0002.png", "i12345.png", "i003.png",
                           "i01234.png", "j0001.png", "i0001.pgm", "i00x1.png", "i.png"}) {
    folder_.write(name, "");
  }
  EXPECT_THAT(numbers(files_of_pattern(pattern("i%04d.png"))), ElementsAre(1, 2, 10, 12345));
  EXPECT_THAT(names(files_of_pattern(pattern("i%04d.pgm"))), ElementsAre("i0001.pgm"));
  EXPECT_TRUE(files_of_pattern(pattern("k%d.png")).empty());
  EXPECT_TRUE(files_of_pattern(pattern("none/i%d.png")).empty());
}

TEST_F(ImageFiles, FindsUnpaddedNumbers) {
  for (const char* name : {"0.png", "7.png", "10.png", "07.png"}) folder_.write(name, "");
  EXPECT_THAT(numbers(files_of_pattern(pattern("%d.png"))), ElementsAre(0, 7, 10));
}

TEST_F(ImageFiles, RefusesOtherPatterns) {
  for (const char* bad : {"%s.png", "%d%d.png", "%.png", "a%4d.png", "%5%.png"}) {
    EXPECT_THAT(test::message_of([&] { files_of_pattern(pattern(bad)); }),
                HasSubstr("is no pattern"))
        << bad;
  }
  EXPECT_THROW(files_of_pattern("a%d/b%d.png"), std::runtime_error);
}

TEST_F(ImageFiles, OrdersAFolderAsPeopleCount) {
  for (const char* name :
       {"a10.png", "a2.png", "a1.jpg", "b1.png", "a002b.png", "note.txt", "a.PGM"}) {
    folder_.write(name, "");
  }
  std::filesystem::create_directory(folder_.path() / "folder.png");
  EXPECT_THAT(names(files_of_folder(folder_.path())),
              ElementsAre("a1.jpg", "a2.png", "a002b.png", "a10.png", "a.PGM", "b1.png"));
  EXPECT_THAT(numbers(files_of_folder(folder_.path())), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST_F(ImageFiles, TakesOneImageAsAFolderOfIt) {
  const auto file = folder_.write("a.png", "");
  EXPECT_THAT(names(files_of_folder(file)), ElementsAre("a.png"));
}

}  // namespace
}  // namespace kestrel
