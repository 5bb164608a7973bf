#include "kestrel/ground/access_token.hpp"

#include <sodium.h>

#include "kestrel/link/key_file.hpp"

namespace kestrel {

AccessToken::AccessToken(const mavlink::SigningKey& key) : text_(2 * key.bytes().size + 1, '\0') {
  sodium_bin2hex(text_.data(), text_.size(), key.bytes().data, key.bytes().size);
  text_.pop_back();  // the zero that ends it
}

AccessToken::~AccessToken() { sodium_memzero(text_.data(), text_.size()); }

bool AccessToken::is_shown_by(std::string_view authorization) const {
  constexpr std::string_view kScheme = "Bearer ";
  if (authorization.substr(0, kScheme.size()) != kScheme) return false;
  const std::string_view shown = authorization.substr(kScheme.size());
  return shown.size() == text_.size() &&
         sodium_memcmp(shown.data(), text_.data(), text_.size()) == 0;
}

AccessToken random_token() { return AccessToken(mavlink::random_key()); }

AccessToken load_token(const std::filesystem::path& file) {
  return AccessToken(mavlink::load_key(file));
}

}  // namespace kestrel
