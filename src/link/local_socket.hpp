#pragma once

#include <filesystem>

/// Sockets of this machine alone (Unix domain), named by a path.
namespace kestrel {

/// Listens there, for this user only; the socket of a program that is gone is replaced. `waiting`
/// may wait to be accepted. The descriptor does not block. Throws std::runtime_error.
int listen_locally(const std::filesystem::path& path, int waiting);

/// A descriptor that may connect; more: flags of socket(2). Throws std::runtime_error.
int local_socket(const std::filesystem::path& path, int more);

/// Connects it to who listens there; false, and errno says why, when that cannot be. Throws
/// std::runtime_error for a path that is none for a socket.
bool connect_locally(int descriptor, const std::filesystem::path& path);

}  // namespace kestrel
