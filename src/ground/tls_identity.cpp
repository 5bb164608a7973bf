#include "kestrel/ground/tls_identity.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include "kestrel/io/text_file.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

template <auto Release>
struct Free {
  template <class T>
  void operator()(T* it) const {
    Release(it);
  }
};
using Bio = std::unique_ptr<BIO, Free<BIO_free>>;
using Certificate = std::unique_ptr<X509, Free<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Free<X509_EXTENSION_free>>;

constexpr std::size_t kLargest = 1 << 20;  // bytes of a PEM file
constexpr long kDay_s = 24L * 3600;

[[noreturn]] void fail(const std::string& why) {
  ERR_clear_error();  // the library's own words would speak of the next failure
  throw std::runtime_error(why);
}

Bio reader(const std::string& pem) {
  return Bio(BIO_new_mem_buf(pem.data(), int(std::min(pem.size(), kLargest))));
}

/// No passphrase: nobody stands by to give one.
int no_passphrase(char*, int, int, void*) { return -1; }

Certificate certificate_of(const std::string& pem) {
  const Bio from = reader(pem);
  Certificate certificate(PEM_read_bio_X509(from.get(), nullptr, no_passphrase, nullptr));
  if (!certificate) fail("TLS: is no certificate in PEM (-----BEGIN CERTIFICATE-----)");
  return certificate;
}

Key key_of(const std::string& pem) {
  const Bio from = reader(pem);
  Key key(PEM_read_bio_PrivateKey(from.get(), nullptr, no_passphrase, nullptr));
  if (!key)
    fail("TLS: is no private key in PEM without a passphrase (-----BEGIN PRIVATE KEY-----)");
  return key;
}

std::string text_of(const Bio& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return {data, std::size_t(size)};
}

/// A file descriptor, closed where it ends.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)) {}
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int get() const { return number_; }

 private:
  int number_;
};

/// The text of a file that only its owner may read or write.
std::string private_text(const fs::path& file) {
  const OpenFile opened(file);
  struct stat status {};
  if (opened.get() < 0 || ::fstat(opened.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    fail(file.string() + ": cannot be opened as a file; name the key file itself");
  }
  if (status.st_uid != ::geteuid()) {
    fail(file.string() + ": belongs to another user; run as the owner of the key");
  }
  if ((status.st_mode & 07777) != (S_IRUSR | S_IWUSR)) {
    fail(file.string() + ": a key is for its owner only; run: chmod 600 " + file.string());
  }
  std::string text(std::min(std::size_t(status.st_size), kLargest), '\0');
  const ssize_t size = ::read(opened.get(), text.data(), text.size());
  text.resize(size > 0 ? std::size_t(size) : 0);
  return text;
}

void add_extension(X509* to, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, to, to, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  if (!extension || X509_add_ext(to, extension.get(), -1) != 1) fail("TLS: no such extension");
}

/// A serial number that no other has: 127 bits of chance, so that browsers tell two runs apart.
void set_serial(X509* of) {
  const std::unique_ptr<BIGNUM, Free<BN_free>> number(BN_new());
  if (BN_rand(number.get(), 127, BN_RAND_TOP_ANY, BN_RAND_BOTTOM_ANY) != 1) {
    fail("TLS: the system has no random numbers");
  }
  BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(of));
}

/// "IP:" or "DNS:", and the host.
std::string alternative(const std::string& host) {
  const bool is_number = host.find(':') != std::string::npos ||
                         host.find_first_not_of("0123456789.") == std::string::npos;
  return (is_number ? "IP:" : "DNS:") + host;
}

void set_names(X509* of, const std::string& host) {
  X509_NAME* name = X509_get_subject_name(of);
  const std::string common = "Kestrel ground station";
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                             reinterpret_cast<const unsigned char*>(common.data()),
                             int(common.size()), -1, 0);
  X509_set_issuer_name(of, name);
  add_extension(of, NID_subject_alt_name, alternative(host) + ",IP:127.0.0.1,IP:::1,DNS:localhost");
  add_extension(of, NID_basic_constraints, "critical,CA:FALSE");
  add_extension(of, NID_ext_key_usage, "serverAuth");
}

}  // namespace

TlsIdentity::TlsIdentity(std::string certificate_pem, std::string key_pem)
    : certificate_pem_(std::move(certificate_pem)), key_pem_(std::move(key_pem)) {
  const Certificate certificate = certificate_of(certificate_pem_);
  const Key key = key_of(key_pem_);
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    fail("TLS: the key is not that of the certificate");
  }
}

TlsIdentity::~TlsIdentity() { OPENSSL_cleanse(key_pem_.data(), key_pem_.size()); }

std::string TlsIdentity::fingerprint() const {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  X509_digest(certificate_of(certificate_pem_).get(), EVP_sha256(), digest.data(), &size);
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    if (i > 0) text += ':';
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

TlsIdentity load_identity(const fs::path& certificate, const fs::path& key) {
  std::string key_pem = private_text(key);
  try {
    return {read_text(certificate), std::move(key_pem)};
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(certificate.string() + " and " + key.string() + ": " + error.what());
  }
}

TlsIdentity self_signed_identity(const std::string& host) {
  const Key key(EVP_EC_gen("P-256"));
  const Certificate certificate(X509_new());
  if (!key || !certificate) fail("TLS: OpenSSL makes no key");
  X509* of = certificate.get();
  X509_set_version(of, 2);  // the third: with extensions
  set_serial(of);
  X509_gmtime_adj(X509_getm_notBefore(of), -kDay_s);
  X509_gmtime_adj(X509_getm_notAfter(of), 365 * kDay_s);
  X509_set_pubkey(of, key.get());
  set_names(of, host);
  if (X509_sign(of, key.get(), EVP_sha256()) == 0) fail("TLS: OpenSSL signs nothing");
  const Bio as_certificate(BIO_new(BIO_s_mem()));
  const Bio as_key(BIO_new(BIO_s_mem()));
  PEM_write_bio_X509(as_certificate.get(), of);
  PEM_write_bio_PrivateKey(as_key.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  return {text_of(as_certificate), text_of(as_key)};
}

}  // namespace kestrel
