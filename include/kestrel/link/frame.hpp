#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "kestrel/link/bytes.hpp"
#include "kestrel/link/message.hpp"

// Frames of MAVLink 2 on the wire (mavlink.io, "Packet Serialization").
namespace kestrel::mavlink {

constexpr std::uint8_t kMagic = 0xFD;
constexpr std::size_t kHeaderSize = 10;
constexpr std::size_t kCrcSize = 2;
constexpr std::size_t kSignatureSize = 13;
constexpr std::size_t kMaxFrame = kHeaderSize + kMaxPayload + kCrcSize + kSignatureSize;
constexpr std::uint8_t kSigned = 0x01;  // flag: a signature follows the checksum

/// Who sends, and the how-manieth frame of theirs this is, modulo 256.
struct Envelope {
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
  std::uint8_t sequence = 0;
};

/// A frame in somebody else's bytes: its length is plausible, and its checksum right if the message
/// is known. Whether a signature is right is for signing to say.
struct FrameView {
  Bytes bytes;                        // all of it: header, payload, checksum, signature if any
  const MessageInfo* info = nullptr;  // nullptr: not in the tables, so nothing was checked

  Envelope envelope() const { return {bytes.data[5], bytes.data[6], bytes.data[4]}; }
  std::uint32_t message_id() const;
  bool is_signed() const { return (bytes.data[2] & kSigned) != 0; }
  Bytes payload() const { return bytes.after(kHeaderSize).first(bytes.data[1]); }
  /// The 13 bytes after the checksum; empty for a frame that is not signed.
  Bytes signature() const { return bytes.after(kHeaderSize + bytes.data[1] + kCrcSize); }
};

/// An intact frame of a known message.
struct Packet {
  Envelope envelope;
  Message message;
};

/// Why bytes are not a frame to be obeyed.
enum class Refusal {
  BadMagic,             // they do not start with the mark of MAVLink 2
  Truncated,            // they end before the frame they announce
  BadCrc,               // damaged, or another dialect's idea of the message
  UnknownMessage,       // not in the tables, hence not verifiable
  UnknownIncompatFlag,  // intact, but asks for what is not supported
};
constexpr std::size_t kRefusals = 5;

/// "bad magic", "truncated", "bad crc", "unknown message", "unknown incompat flag".
const char* name(Refusal refusal);

/// What stands at the start of some bytes, and how many of them it takes.
template <class Content>
struct AtStart {
  std::variant<Content, Refusal> content;
  std::size_t size = 0;
};
using Parsed = AtStart<FrameView>;
using Decoded = AtStart<Packet>;

/// A frame ready to be sent.
struct EncodedFrame {
  std::array<std::uint8_t, kMaxFrame> data{};
  std::size_t size = 0;

  Bytes bytes() const { return {data.data(), size}; }
};

/// The frame of a message, unsigned.
EncodedFrame encode(const Message& message, const Envelope& envelope);

/// The frame that starts with the first byte, or why there is none and the size it claims. Of an
/// unknown message a view without info, or UnknownMessage when it has flags unknown too.
Parsed frame_at_start(Bytes bytes);

/// What stands at the start of a datagram: a frame, or why not and how many bytes to pass over.
/// Read a datagram by
///     for (Bytes rest = datagram; rest.size > 0; rest = rest.after(parse(rest).size))
/// which always ends. After damage the next intact frame is found wherever it starts. An unknown
/// message is a frame when it ends where the datagram does, or where another frame seems to start;
/// else it is refused as BadCrc. Empty bytes are Truncated, with size 0.
Parsed parse(Bytes bytes);

/// The same with the message read; an unknown one is refused. Signed or not is all the same: the
/// one who needs to know asks parse.
Decoded decode(Bytes bytes);

}  // namespace kestrel::mavlink
