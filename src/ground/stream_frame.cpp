#include "kestrel/ground/stream_frame.hpp"

#include <stdexcept>

namespace kestrel {
namespace {

constexpr std::size_t kHeader = 8;

void put_length(std::string& to, std::size_t length) {
  if (length > kMaxStreamPart) throw std::invalid_argument("stream: a part is too long");
  for (int shift = 24; shift >= 0; shift -= 8) to.push_back(char((length >> shift) & 0xFF));
}

std::size_t length_at(const std::string& bytes, std::size_t at) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    length = (length << 8) | static_cast<unsigned char>(bytes[at + i]);
  }
  if (length > kMaxStreamPart) throw std::runtime_error("stream: a length is damaged");
  return length;
}

}  // namespace

std::string stream_frame(std::string_view json, const std::vector<unsigned char>& jpeg) {
  std::string bytes;
  bytes.reserve(kHeader + json.size() + jpeg.size());
  put_length(bytes, json.size());
  put_length(bytes, jpeg.size());
  bytes.append(json);
  bytes.append(jpeg.begin(), jpeg.end());
  return bytes;
}

std::optional<StreamFrame> StreamReader::next() {
  if (waiting_.size() < kHeader) return std::nullopt;
  const std::size_t json = length_at(waiting_, 0);
  const std::size_t jpeg = length_at(waiting_, 4);
  if (waiting_.size() < kHeader + json + jpeg) return std::nullopt;
  StreamFrame frame{waiting_.substr(kHeader, json), waiting_.substr(kHeader + json, jpeg)};
  waiting_.erase(0, kHeader + json + jpeg);
  return frame;
}

}  // namespace kestrel
