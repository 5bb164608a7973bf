#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "kestrel/link/signing.hpp"

namespace kestrel {

/// What a viewer must show to be served: 64 hexadecimal digits. Its bytes are wiped where it ends.
class AccessToken {
 public:
  explicit AccessToken(const mavlink::SigningKey& key);
  ~AccessToken();
  AccessToken(const AccessToken&) = default;
  AccessToken& operator=(const AccessToken&) = default;

  /// For the one line that tells the owner; to be printed nowhere else.
  const std::string& text() const { return text_; }

  /// True for "Bearer " and the token, the value of the header Authorization (RFC 6750, 2.1). Takes
  /// the same time wherever a wrong token of the right length is wrong.
  bool is_shown_by(std::string_view authorization) const;

 private:
  std::string text_;
};

/// One that nobody can guess. Throws std::runtime_error when the kernel has no random numbers.
AccessToken random_token();

/// The token in a file as `kestrel key FILE` makes it, mode 0600. Throws std::runtime_error as
/// mavlink::load_key.
AccessToken load_token(const std::filesystem::path& file);

}  // namespace kestrel
