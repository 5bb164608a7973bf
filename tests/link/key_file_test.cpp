#include "kestrel/link/key_file.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samples.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::mavlink {
namespace {

using std::filesystem::path;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kDigits = "00112233445566778899aabbccddeeffFFEEDDCCBBAA99887766554433221101";

/// A key file as it should be, but for what is in it and its mode.
path key_file(const test::TempFolder& folder, const std::string& text, mode_t mode = 0600) {
  const path file = folder.write("a.key", text);
  ::chmod(file.c_str(), mode);
  return file;
}

std::string failure(const path& file) {
  return test::message_of([&] { load_key(file); });
}

unsigned mode_of(const path& file) {
  struct stat status {};
  ::stat(file.c_str(), &status);
  return status.st_mode & 07777;
}

TEST(KeyFile, IsReadAsItWasWritten) {
  const test::TempFolder folder(test::memory_folder());
  const SigningKey key = random_key();
  const mode_t umask = ::umask(0277);  // the worst there is
  write_key(folder / "new.key", key);
  ::umask(umask);
  EXPECT_EQ(mode_of(folder / "new.key"), 0600u);
  EXPECT_EQ(test::copy(load_key(folder / "new.key").bytes()), test::copy(key.bytes()));
  EXPECT_EQ(std::filesystem::file_size(folder / "new.key"), 65u);
}

TEST(KeyFile, HoldsHexadecimalDigits) {
  const test::TempFolder folder(test::memory_folder());
  const test::Buffer bytes = test::copy(load_key(key_file(folder, kDigits + "\n")).bytes());
  EXPECT_EQ(bytes[0], 0x00);
  EXPECT_EQ(bytes[1], 0x11);
  EXPECT_EQ(bytes[15], 0xFF);
  EXPECT_EQ(bytes[17], 0xEE);
  EXPECT_EQ(bytes[31], 0x01);
}

TEST(KeyFile, OfAnyOtherModeIsRefused) {
  const test::TempFolder folder(test::memory_folder());
  for (const mode_t mode : {0644, 0640, 0604, 0660, 0606, 0700, 0601, 0400, 0200, 04600, 0666}) {
    const path file = key_file(folder, kDigits + "\n", mode);
    if (::geteuid() != 0 && (mode & S_IRUSR) == 0) continue;  // cannot even be opened
    EXPECT_THAT(failure(file), AllOf(StartsWith(file.string() + ": has mode "),
                                     HasSubstr("run: chmod 600 " + file.string())));
  }
  EXPECT_EQ(failure(key_file(folder, kDigits + "\n", 0600)), "nothing was thrown");
}

TEST(KeyFile, OfAnotherOwnerIsRefused) {
  const test::TempFolder folder(test::memory_folder());
  const path file = key_file(folder, kDigits + "\n");
  if (::chown(file.c_str(), ::geteuid() + 1, gid_t(-1)) != 0) {
    GTEST_SKIP() << "only root may give files away";
  }
  EXPECT_THAT(failure(file), HasSubstr("belongs to another user"));
}

TEST(KeyFile, IsAFileOfItsOwn) {
  const test::TempFolder folder(test::memory_folder());
  const path file = key_file(folder, kDigits + "\n");
  std::filesystem::create_symlink(file, folder / "link.key");
  EXPECT_THAT(failure(folder / "link.key"), HasSubstr("symbolic link"));
  EXPECT_THAT(failure(folder.path()), HasSubstr("is no regular file"));
  ASSERT_EQ(::mkfifo((folder / "pipe.key").c_str(), 0600), 0);
  EXPECT_THAT(failure(folder / "pipe.key"), HasSubstr("is no regular file"));
  EXPECT_THAT(failure(folder / "none.key"), HasSubstr("kestrel key"));
}

TEST(KeyFile, HoldsAKeyAndNothingElse) {
  const test::TempFolder folder(test::memory_folder());
  std::string no_digit = kDigits + "\n";
  no_digit[20] = 'g';
  for (const std::string& text :
       {std::string(), std::string("\n"), kDigits, kDigits + "\n\n", kDigits + " ", no_digit,
        kDigits.substr(1) + "\n", kDigits + "0\n", kDigits + "\r\n", std::string(64, '0') + "\n",
        std::string(100000, 'a')}) {
    const std::string message = failure(key_file(folder, text));
    EXPECT_THAT(message, HasSubstr("a.key: holds no key"));
    EXPECT_THAT(message, Not(HasSubstr("2233")));  // nothing of a key in a log
  }
}

TEST(KeyFile, IsNeverOverwritten) {
  const test::TempFolder folder(test::memory_folder());
  const path file = folder / "a.key";
  const SigningKey key = random_key();
  write_key(file, key);
  EXPECT_THAT(test::message_of([&] { write_key(file, random_key()); }),
              HasSubstr("is there already"));
  EXPECT_EQ(test::copy(load_key(file).bytes()), test::copy(key.bytes()));
  // Nor through a link that leads nowhere.
  std::filesystem::create_symlink(folder / "elsewhere", folder / "link");
  EXPECT_NE(test::message_of([&] { write_key(folder / "link", key); }), "nothing was thrown");
  EXPECT_FALSE(std::filesystem::exists(folder / "elsewhere"));
  EXPECT_THAT(test::message_of([&] { write_key(folder / "no" / "folder.key", key); }),
              HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace kestrel::mavlink
