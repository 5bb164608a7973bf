#pragma once

#include <filesystem>
#include <string>

namespace kestrel {

/// What a server shows and proves over TLS: a certificate (the chain may follow it) and its private
/// key. The key is wiped where it ends.
class TlsIdentity {
 public:
  /// Of PEM texts. Throws std::runtime_error, with nothing of the key in it, when one of them is
  /// none, when the key asks for a passphrase, or when the two do not belong together.
  TlsIdentity(std::string certificate_pem, std::string key_pem);
  ~TlsIdentity();
  TlsIdentity(const TlsIdentity&) = default;
  TlsIdentity& operator=(const TlsIdentity&) = default;

  const std::string& certificate_pem() const { return certificate_pem_; }
  const std::string& key_pem() const { return key_pem_; }

  /// SHA-256 of the certificate (DER), as browsers show it: 32 bytes "AB:CD:...".
  std::string fingerprint() const;

 private:
  std::string certificate_pem_;
  std::string key_pem_;
};

/// The identity in two files, PEM. The key must be a regular file of mode 0600 that belongs to the
/// user: it is looked at on the open file. Throws std::runtime_error that names the file and the
/// remedy.
TlsIdentity load_identity(const std::filesystem::path& certificate,
                          const std::filesystem::path& key);

/// A new one that nobody vouches for: ECDSA on P-256, for the host (a number), 127.0.0.1, ::1 and
/// localhost, valid from a day ago (clocks differ) for a year. It is in memory only. Whoever meets
/// it compares the fingerprint. Throws std::runtime_error when OpenSSL cannot.
TlsIdentity self_signed_identity(const std::string& host);

}  // namespace kestrel
