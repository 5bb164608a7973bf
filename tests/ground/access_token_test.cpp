#include "kestrel/ground/access_token.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "kestrel/link/key_file.hpp"

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

AccessToken known_token() {
  mavlink::SigningKey::Secret secret{};
  for (std::size_t i = 0; i < secret.size(); ++i) secret[i] = std::uint8_t(i);
  return AccessToken(mavlink::SigningKey(secret));
}

TEST(AccessToken, IsTheKeyInHexadecimal) {
  EXPECT_EQ(known_token().text(),
            "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f");
}

TEST(AccessToken, OnlyTheWholeTokenBehindItsSchemeIsTaken) {
  const AccessToken token = known_token();
  EXPECT_TRUE(token.is_shown_by("Bearer " + token.text()));
  EXPECT_FALSE(token.is_shown_by(token.text()));
  EXPECT_FALSE(token.is_shown_by("Basic " + token.text()));
  EXPECT_FALSE(token.is_shown_by("bearer " + token.text()));
  EXPECT_FALSE(token.is_shown_by("Bearer " + token.text() + "0"));
  EXPECT_FALSE(token.is_shown_by("Bearer " + token.text().substr(1)));
  EXPECT_FALSE(token.is_shown_by("Bearer "));
  EXPECT_FALSE(token.is_shown_by(""));
}

TEST(AccessToken, OneWrongDigitIsRefusedWhereverItIs) {
  const AccessToken token = known_token();
  for (std::size_t i = 0; i < token.text().size(); ++i) {
    std::string wrong = token.text();
    wrong[i] = wrong[i] == 'f' ? 'e' : 'f';
    EXPECT_FALSE(token.is_shown_by("Bearer " + wrong)) << i;
  }
}

TEST(AccessToken, NoTwoRandomOnesAreTheSame) {
  EXPECT_NE(random_token().text(), random_token().text());
}

TEST(AccessToken, ComesFromAFileThatIsItsOwnersAlone) {
  const test::TempFolder folder;
  const mavlink::SigningKey key = mavlink::random_key();
  mavlink::write_key(folder / "token", key);
  EXPECT_EQ(load_token(folder / "token").text(), AccessToken(key).text());
  std::filesystem::permissions(folder / "token", std::filesystem::perms(0640));
  EXPECT_NE(test::message_of([&] { load_token(folder / "token"); }).find("chmod 600"),
            std::string::npos);
}

}  // namespace
}  // namespace kestrel
