#include "kestrel/link/message.hpp"

#include <algorithm>
#include <cstring>

#include "kestrel/link/crc.hpp"

#include "layout.hpp"

namespace kestrel::mavlink {
namespace {

/// Little-endian on any machine.
template <class T>
void store(T value, std::uint8_t* to) {
  if constexpr (std::is_same_v<T, float>) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    store(bits, to);
  } else {
    for (std::size_t i = 0; i < sizeof(T); ++i) to[i] = std::uint8_t(value >> (8 * i));
  }
}

template <class T>
T load(const std::uint8_t* from) {
  if constexpr (std::is_same_v<T, float>) {
    const auto bits = load<std::uint32_t>(from);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  } else {
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value = T(value | T(T(from[i]) << (8 * i)));
    return value;
  }
}

template <class M>
void store_fields(const M& message, std::uint8_t* to) {
  std::apply(
      [&](const auto&... fields) {
        ((store(message.*fields.member, to), to += sizeof(message.*fields.member)), ...);
      },
      Layout<M>::kFields);
}

template <class M>
Message load_fields(const std::uint8_t* from) {
  M message;
  const auto take = [&](auto& value) {
    value = load<std::decay_t<decltype(value)>>(from);
    from += sizeof value;
  };
  std::apply([&](const auto&... fields) { (take(message.*fields.member), ...); },
             Layout<M>::kFields);
  return message;
}

/// What decoding needs to know of a message.
struct Entry {
  std::uint32_t id;
  std::uint8_t crc_extra;
  Message (*load)(const std::uint8_t* payload);  // of kMaxPayload bytes
};

template <class... M>
constexpr std::array<Entry, sizeof...(M)> entries(const std::variant<M...>*) {
  return {Entry{Layout<M>::kId, Layout<M>::kCrcExtra, load_fields<M>}...};
}
constexpr auto kEntries = entries(static_cast<const Message*>(nullptr));

const Entry* entry_of(std::uint32_t id) {
  const auto found = std::find_if(kEntries.begin(), kEntries.end(),
                                  [id](const Entry& entry) { return entry.id == id; });
  return found == kEntries.end() ? nullptr : &*found;
}

// Places in the header.
constexpr std::size_t kLength = 1, kIncompat = 2, kSequence = 4, kSystem = 5, kComponent = 6,
                      kMessageId = 7;
constexpr std::uint8_t kSigned = 0x01;

/// Checksum of a frame without its mark and its own last two bytes.
std::uint16_t frame_crc(Bytes frame, std::uint8_t extra) {
  return kestrel::crc_add(
      kestrel::crc_add(kCrcStart, frame.first(frame.size - kCrcSize).after(kLength)), extra);
}

std::uint32_t message_id(Bytes frame) {
  return frame.data[kMessageId] | frame.data[kMessageId + 1] << 8 |
         frame.data[kMessageId + 2] << 16;
}

Packet unpacked(Bytes frame, const Entry& entry) {
  // Trimmed zeros come back; what a newer definition appends is not looked at.
  std::array<std::uint8_t, kMaxPayload> payload{};
  std::copy_n(frame.data + kHeaderSize, frame.data[kLength], payload.begin());
  return {{frame.data[kSystem], frame.data[kComponent], frame.data[kSequence]},
          entry.load(payload.data())};
}

/// The frame that starts with the first byte, or why there is none and the size it claims.
Decoded frame_at_start(Bytes bytes) {
  if (bytes.size == 0) return {Refusal::Truncated, 0};
  if (bytes.data[0] != kMagic) {
    return {Refusal::BadMagic,
            std::size_t(std::find(bytes.begin(), bytes.end(), kMagic) - bytes.begin())};
  }
  if (bytes.size < kHeaderSize + kCrcSize) return {Refusal::Truncated, bytes.size};
  const std::size_t size = kHeaderSize + bytes.data[kLength] + kCrcSize;
  if (bytes.size < size) return {Refusal::Truncated, bytes.size};

  const Bytes frame = bytes.first(size);
  const bool is_signed = (frame.data[kIncompat] & kSigned) != 0;
  const std::size_t whole = std::min(bytes.size, size + (is_signed ? kSignatureSize : 0));
  const Entry* entry = entry_of(message_id(frame));
  if (entry == nullptr) return {Refusal::UnknownMessage, whole};
  const auto sent_crc = load<std::uint16_t>(frame.data + size - kCrcSize);
  if (frame_crc(frame, entry->crc_extra) != sent_crc) return {Refusal::BadCrc, size};
  if (frame.data[kIncompat] != 0) return {Refusal::UnknownIncompatFlag, whole};
  return {unpacked(frame, *entry), size};
}

bool is_refused_for(const Decoded& decoded, Refusal refusal) {
  const auto* reason = std::get_if<Refusal>(&decoded.content);
  return reason != nullptr && *reason == refusal;
}

/// True when the checksum vouches for where the frame starts and ends.
bool is_intact(const Decoded& decoded) {
  return std::holds_alternative<Packet>(decoded.content) ||
         is_refused_for(decoded, Refusal::UnknownIncompatFlag);
}

bool ends_at_a_boundary(const Decoded& decoded, Bytes bytes) {
  const Bytes rest = bytes.after(decoded.size);
  return rest.size == 0 || rest.data[0] == kMagic;
}

}  // namespace

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
  return std::visit(
      [&](const auto& m) {
        using M = std::decay_t<decltype(m)>;
        EncodedFrame frame;
        std::uint8_t* const payload = frame.data.data() + kHeaderSize;
        store_fields(m, payload);
        std::size_t length = Layout<M>::kLength;
        while (length > 1 && payload[length - 1] == 0) --length;
        frame.size = kHeaderSize + length + kCrcSize;
        frame.data[0] = kMagic;
        frame.data[kLength] = std::uint8_t(length);
        frame.data[kSequence] = envelope.sequence;
        frame.data[kSystem] = envelope.system_id;
        frame.data[kComponent] = envelope.component_id;
        for (std::size_t i = 0; i < 3; ++i) {
          frame.data[kMessageId + i] = std::uint8_t(Layout<M>::kId >> (8 * i));
        }
        store(frame_crc(frame.bytes(), Layout<M>::kCrcExtra), payload + length);
        return frame;
      },
      message);
}

Decoded decode(Bytes bytes) {
  const Decoded first = frame_at_start(bytes);
  if (is_intact(first) || is_refused_for(first, Refusal::BadMagic)) return first;
  if (is_refused_for(first, Refusal::UnknownMessage) && ends_at_a_boundary(first, bytes)) {
    return first;
  }
  // The size it claims cannot be trusted: an intact frame may start within.
  for (std::size_t i = 1; i < first.size; ++i) {
    if (bytes.data[i] == kMagic && is_intact(frame_at_start(bytes.after(i)))) {
      return {first.content, i};
    }
  }
  return first;
}

}  // namespace kestrel::mavlink
