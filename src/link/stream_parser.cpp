#include "kestrel/link/stream_parser.hpp"

#include <algorithm>
#include <variant>

namespace kestrel::mavlink {

Bytes StreamParser::push(Bytes chunk) {
  std::copy(buffer_.begin() + std::ptrdiff_t(start_), buffer_.begin() + std::ptrdiff_t(end_),
            buffer_.begin());
  end_ -= start_;
  start_ = 0;
  const Bytes fitting = chunk.first(kRoom - end_);
  std::copy(fitting.begin(), fitting.end(), buffer_.begin() + std::ptrdiff_t(end_));
  end_ += fitting.size;
  return chunk.after(fitting.size);
}

/// A frame whose end is trusted.
Parsed StreamParser::taken(const Parsed& parsed) {
  start_ += parsed.size;
  in_step_ = true;
  return parsed;
}

/// Of what was claimed, all up to the next mark.
Parsed StreamParser::passed_over(Refusal reason, std::size_t claimed) {
  const Bytes behind = pending().first(claimed).after(1);
  const std::size_t size =
      1 + std::size_t(std::find(behind.begin(), behind.end(), kMagic) - behind.begin());
  start_ += size;
  in_step_ = false;
  return {reason, size};
}

std::optional<Parsed> StreamParser::next() {
  const Bytes rest = pending();
  if (rest.size == 0) return std::nullopt;
  if (rest.data[0] != kMagic) return passed_over(Refusal::BadMagic, rest.size);
  if (rest.size < kHeaderSize) return std::nullopt;
  const bool known = message_info(FrameView{rest, nullptr}.message_id()) != nullptr;
  if (!known && !in_step_) return passed_over(Refusal::UnknownMessage, kHeaderSize);

  const Parsed first = frame_at_start(rest);
  if (const auto* refusal = std::get_if<Refusal>(&first.content)) {
    if (*refusal == Refusal::Truncated) return std::nullopt;
    if (*refusal == Refusal::UnknownIncompatFlag) return taken(first);
    return passed_over(*refusal, first.size);
  }
  if (known) return taken(first);
  const Bytes behind = rest.after(first.size);
  if (behind.size == 0) return std::nullopt;
  return behind.data[0] == kMagic ? taken(first) : passed_over(Refusal::BadCrc, first.size);
}

}  // namespace kestrel::mavlink
