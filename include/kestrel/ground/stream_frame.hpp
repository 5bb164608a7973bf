#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kestrel {

// One frame of the stream to a viewer: two lengths, most significant byte first, of the words and
// of the picture (32 bits each); then the words, JSON; then the picture, JPEG. Words and picture
// are of the same frame, so that what is drawn over the picture fits it.

/// The longest of either part, bytes: beyond it a length is damage.
constexpr std::uint32_t kMaxStreamPart = 8U << 20;

/// The frame's bytes. A picture of no bytes means that there is none. Throws std::invalid_argument
/// for a part that is too long.
std::string stream_frame(std::string_view json, const std::vector<unsigned char>& jpeg);

/// A frame as it was taken off the stream.
struct StreamFrame {
  std::string json;
  std::string jpeg;
};

/// Puts the frames of a stream together, however it is cut.
class StreamReader {
 public:
  void add(std::string_view bytes) { waiting_.append(bytes); }

  /// The next whole frame; empty until there is one. Throws std::runtime_error for lengths that no
  /// frame has: nothing behind them can be trusted.
  std::optional<StreamFrame> next();

 private:
  std::string waiting_;
};

}  // namespace kestrel
