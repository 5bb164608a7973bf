#include "kestrel/ground/tls_identity.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

class TlsFiles : public testing::Test {
 protected:
  fs::path file(const std::string& name, const std::string& text, fs::perms mode) {
    std::ofstream(folder_ / name) << text;
    fs::permissions(folder_ / name, mode);
    return folder_ / name;
  }
  fs::path certificate() { return file("cert.pem", made_.certificate_pem(), fs::perms(0644)); }
  fs::path key(const std::string& text, unsigned mode = 0600) {
    return file("key.pem", text, fs::perms(mode));
  }
  /// Why the two files are refused.
  std::string refusal(const fs::path& certificate, const fs::path& key) {
    try {
      load_identity(certificate, key);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  const test::TempFolder folder_;
  const TlsIdentity made_ = self_signed_identity("192.0.2.7");
};

TEST_F(TlsFiles, WhatWasWrittenIsReadBack) {
  const TlsIdentity read = load_identity(certificate(), key(made_.key_pem()));
  EXPECT_EQ(read.fingerprint(), made_.fingerprint());
  EXPECT_EQ(read.fingerprint().size(), 32u * 3 - 1);
}

TEST_F(TlsFiles, EachSelfSignedOneIsNew) {
  EXPECT_NE(self_signed_identity("127.0.0.1").fingerprint(), made_.fingerprint());
  EXPECT_NO_THROW(self_signed_identity("::1"));
  EXPECT_NO_THROW(self_signed_identity("localhost"));
}

TEST_F(TlsFiles, AKeyThatOthersMayReadIsRefused) {
  for (const unsigned mode : {0644U, 0640U, 0400U, 0660U}) {
    const std::string why = refusal(certificate(), key(made_.key_pem(), mode));
    EXPECT_TRUE(says(why, "chmod 600")) << mode << ": " << why;
    fs::permissions(folder_ / "key.pem", fs::perms(0600));
  }
}

TEST_F(TlsFiles, WhatIsNoPemIsNamed) {
  const std::string no_key = refusal(certificate(), key("hello"));
  EXPECT_TRUE(says(no_key, "no private key")) << no_key;
  const std::string cut = refusal(certificate(), key(made_.key_pem().substr(0, 100)));
  EXPECT_TRUE(says(cut, "no private key")) << cut;
  EXPECT_FALSE(says(cut, made_.key_pem().substr(40, 20))) << "nothing of the key is repeated";
  const fs::path nonsense = file("nonsense.pem", "hello", fs::perms(0644));
  const std::string no_certificate = refusal(nonsense, key(made_.key_pem()));
  EXPECT_TRUE(says(no_certificate, "no certificate")) << no_certificate;
  EXPECT_TRUE(says(no_certificate, "nonsense.pem")) << no_certificate;
}

TEST_F(TlsFiles, TheKeyOfAnotherCertificateIsRefused) {
  const std::string why = refusal(certificate(), key(self_signed_identity("127.0.0.1").key_pem()));
  EXPECT_TRUE(says(why, "not that of the certificate")) << why;
}

TEST_F(TlsFiles, MissingFilesAndLinksAreNamed) {
  const std::string missing = refusal(certificate(), folder_ / "none.pem");
  EXPECT_TRUE(says(missing, "none.pem")) << missing;
  key(made_.key_pem());
  fs::create_symlink(folder_ / "key.pem", folder_ / "link.pem");
  EXPECT_TRUE(says(refusal(certificate(), folder_ / "link.pem"), "name the key file itself"));
  EXPECT_NE(refusal(folder_ / "none.pem", folder_ / "key.pem"), "");
}

}  // namespace
}  // namespace kestrel
