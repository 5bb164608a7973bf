#include "kestrel/link/frame.hpp"

#include <algorithm>

#include "kestrel/link/crc.hpp"

namespace kestrel::mavlink {
namespace {

// Places in the header.
constexpr std::size_t kLength = 1, kIncompat = 2, kSequence = 4, kSystem = 5, kComponent = 6,
                      kMessageId = 7;

/// Checksum of a frame's header, without its mark, and payload.
std::uint16_t frame_crc(Bytes header_and_payload, std::uint8_t extra) {
  return crc_add(crc_add(kCrcStart, header_and_payload.after(kLength)), extra);
}

template <class Content>
bool is_refused_for(const AtStart<Content>& at_start, Refusal refusal) {
  const auto* reason = std::get_if<Refusal>(&at_start.content);
  return reason != nullptr && *reason == refusal;
}

/// True when a right checksum vouches for where the frame starts and ends.
bool is_intact(const Parsed& parsed) {
  const auto* frame = std::get_if<FrameView>(&parsed.content);
  return frame != nullptr ? frame->info != nullptr
                          : is_refused_for(parsed, Refusal::UnknownIncompatFlag);
}

bool ends_at_a_boundary(const Parsed& parsed, Bytes bytes) {
  const Bytes rest = bytes.after(parsed.size);
  return rest.size == 0 || rest.data[0] == kMagic;
}

}  // namespace

std::uint32_t FrameView::message_id() const {
  return std::uint32_t(bytes.data[kMessageId]) | std::uint32_t(bytes.data[kMessageId + 1]) << 8 |
         std::uint32_t(bytes.data[kMessageId + 2]) << 16;
}

const char* name(Refusal refusal) {
  switch (refusal) {
    case Refusal::BadMagic:
      return "bad magic";
    case Refusal::Truncated:
      return "truncated";
    case Refusal::BadCrc:
      return "bad crc";
    case Refusal::UnknownMessage:
      return "unknown message";
    case Refusal::UnknownIncompatFlag:
      return "unknown incompat flag";
  }
  return "";
}

EncodedFrame encode(const Message& message, const Envelope& envelope) {
  const MessageInfo& info = info_of(message);
  const Payload payload = payload_of(message);
  EncodedFrame frame;
  frame.data[0] = kMagic;
  frame.data[kLength] = std::uint8_t(payload.size);
  frame.data[kSequence] = envelope.sequence;
  frame.data[kSystem] = envelope.system_id;
  frame.data[kComponent] = envelope.component_id;
  for (std::size_t i = 0; i < 3; ++i) {
    frame.data[kMessageId + i] = std::uint8_t(info.id >> (8 * i));
  }
  std::copy_n(payload.data.begin(), payload.size, frame.data.begin() + kHeaderSize);
  const std::size_t end = kHeaderSize + payload.size;
  const std::uint16_t crc = frame_crc({frame.data.data(), end}, info.crc_extra);
  frame.data[end] = std::uint8_t(crc);
  frame.data[end + 1] = std::uint8_t(crc >> 8);
  frame.size = end + kCrcSize;
  return frame;
}

Parsed frame_at_start(Bytes bytes) {
  if (bytes.size == 0) return {Refusal::Truncated, 0};
  if (bytes.data[0] != kMagic) {
    return {Refusal::BadMagic,
            std::size_t(std::find(bytes.begin(), bytes.end(), kMagic) - bytes.begin())};
  }
  if (bytes.size < kHeaderSize + kCrcSize) return {Refusal::Truncated, bytes.size};
  const std::size_t crc_at = kHeaderSize + bytes.data[kLength];
  const bool is_signed = (bytes.data[kIncompat] & kSigned) != 0;
  const std::size_t size = crc_at + kCrcSize + (is_signed ? kSignatureSize : 0);
  if (bytes.size < size) return {Refusal::Truncated, bytes.size};

  FrameView frame{bytes.first(size), nullptr};
  frame.info = message_info(frame.message_id());
  const bool known_flags = (bytes.data[kIncompat] & ~kSigned) == 0;
  if (frame.info == nullptr) {
    // Unknown flags may mean another length, and no checksum speaks for this one.
    return known_flags ? Parsed{frame, size} : Parsed{Refusal::UnknownMessage, size};
  }
  const auto sent_crc = std::uint16_t(bytes.data[crc_at] | bytes.data[crc_at + 1] << 8);
  if (frame_crc(bytes.first(crc_at), frame.info->crc_extra) != sent_crc) {
    return {Refusal::BadCrc, size};
  }
  if (!known_flags) return {Refusal::UnknownIncompatFlag, size};
  return {frame, size};
}

Parsed parse(Bytes bytes) {
  const Parsed first = frame_at_start(bytes);
  if (is_intact(first) || is_refused_for(first, Refusal::BadMagic)) return first;
  const bool unknown = std::holds_alternative<FrameView>(first.content);
  if (unknown && ends_at_a_boundary(first, bytes)) return first;
  const Refusal reason = unknown ? Refusal::BadCrc : std::get<Refusal>(first.content);
  // The size it claims cannot be trusted: an intact frame may start within.
  for (std::size_t i = 1; i < first.size; ++i) {
    if (bytes.data[i] == kMagic && is_intact(frame_at_start(bytes.after(i)))) return {reason, i};
  }
  return {reason, first.size};
}

Decoded decode(Bytes bytes) {
  const Parsed parsed = parse(bytes);
  const auto* frame = std::get_if<FrameView>(&parsed.content);
  if (frame == nullptr) return {std::get<Refusal>(parsed.content), parsed.size};
  const auto message = message_of(frame->message_id(), frame->payload());
  if (!message) return {Refusal::UnknownMessage, parsed.size};
  return {Packet{frame->envelope(), *message}, parsed.size};
}

}  // namespace kestrel::mavlink
