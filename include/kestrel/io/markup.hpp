#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kestrel {

/// Text as XML or HTML shows it literally, in content and in quoted attributes: & < > " ' escaped,
/// control characters that XML forbids dropped, invalid UTF-8 replaced by U+FFFD.
std::string escaped(std::string_view text);

/// A file's name as a relative URL: all but letters, digits and -._~/ percent-encoded; a name that
/// could be read as a scheme or a root is anchored with "./".
std::string relative_url(std::string_view file_name);

/// RFC 4648 base64.
std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace kestrel
