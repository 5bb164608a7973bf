#pragma once

#include <filesystem>

#include "kestrel/link/signing.hpp"

// Signing keys in files: 64 hexadecimal digits and a newline, readable and writable by their owner
// and nobody else.
namespace kestrel::mavlink {

/// The key in a file. Throws std::runtime_error, naming the file and the remedy but nothing of what
/// is in it, when the file is missing, is no regular file or a symbolic link, belongs to another
/// user, has any mode but 0600 (its mode is looked at on the open file, so that none can take its
/// place in between), or holds anything but a key.
SigningKey load_key(const std::filesystem::path& file);

/// Writes a key to a new file of mode 0600, whatever the umask, on the disk when this returns.
/// Throws std::runtime_error when there is such a file already, which stays as it is, or when it
/// cannot be written, and then leaves none.
void write_key(const std::filesystem::path& file, const SigningKey& key);

}  // namespace kestrel::mavlink
