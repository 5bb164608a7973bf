#pragma once

#include <filesystem>
#include <string>

namespace kestrel {

/// A local socket (AF_UNIX, mode 0600: for this user only) that answers each connection with one
/// text and closes it. It never waits: who does not take the text at once does not get all of it.
/// Owns its descriptor and the file of the socket.
class StatusServer {
 public:
  /// Takes the place of a socket that nobody listens to any more. Throws std::runtime_error when
  /// the path is too long, is another file, belongs to a running program, or cannot be made.
  explicit StatusServer(const std::filesystem::path& path);
  StatusServer(const StatusServer&) = delete;
  StatusServer& operator=(const StatusServer&) = delete;
  ~StatusServer();

  int descriptor() const { return descriptor_; }

  /// True when somebody had asked and was answered with the text.
  template <class Text>
  bool answer(const Text& text) noexcept {
    const int asker = accept_one();
    if (asker < 0) return false;
    give(asker, text());
    return true;
  }

 private:
  int accept_one() noexcept;
  static void give(int asker, const std::string& text) noexcept;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// What the server at the path answers. Throws std::runtime_error when there is none, or it does
/// not answer within timeout_s.
std::string ask_status(const std::filesystem::path& path, double timeout_s);

}  // namespace kestrel
