// Kestrel's codec for a peer that is another program (tests/link/peer).
//   peer_codec tables        what is known of each message, one a line: name, id, CRC_EXTRA, length
//                            with extensions, and of each field name:type:count:offset:extension
//   peer_codec write COUNT   writes COUNT random messages of each kind, one a line: name, system,
//                            component, sequence, a word for each field, frame
//   peer_codec read          reads frames, one a line, and for each writes a line like that: what
//   it
//                            decodes from the frame, and the frame it encodes from that
// With a key of 64 hexadecimal digits as a last argument, frames are written and read signed; the
// line of a frame whose signature is not right is "forged".
// A field's word: its elements in decimal, joined by commas; floats as their bits, characters as
// bytes. Frames are in hexadecimal.
#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

#include "kestrel/link/signing.hpp"

#include "samples.hpp"
#include "support/random.hpp"

namespace {

using namespace kestrel;
using namespace kestrel::mavlink;

std::string hex(Bytes bytes) {
  std::ostringstream text;
  text << std::hex << std::setfill('0');
  for (const std::uint8_t byte : bytes) text << std::setw(2) << int(byte);
  return text.str();
}

test::Buffer bytes_of(const std::string& hex_text) {
  test::Buffer bytes;
  for (std::size_t i = 0; i + 1 < hex_text.size(); i += 2) {
    bytes.push_back(std::uint8_t(std::stoi(hex_text.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

/// The element that starts there, in decimal.
std::string element(FieldType type, const std::uint8_t* from) {
  const std::size_t size = size_of(type);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) bits |= std::uint64_t(from[i]) << (8 * i);
  const bool is_signed = name(type).substr(0, 3) == "int";
  const unsigned unused = unsigned(64 - 8 * size);
  return is_signed ? std::to_string(std::int64_t(bits << unused) >> unused) : std::to_string(bits);
}

std::string word_of(const FieldInfo& field, const test::Buffer& payload) {
  std::string word;
  for (std::size_t at = 0; at < field.size(); at += size_of(field.type)) {
    word += (at > 0 ? "," : "") + element(field.type, payload.data() + field.offset + at);
  }
  return word;
}

std::string line_of(const Packet& packet, Bytes frame) {
  const MessageInfo& info = info_of(packet.message);
  const test::Buffer payload = test::fields(packet.message);
  std::ostringstream line;
  line << info.name << ' ' << int(packet.envelope.system_id) << ' '
       << int(packet.envelope.component_id) << ' ' << int(packet.envelope.sequence) << ' ';
  for (const FieldInfo& field : info) line << word_of(field, payload) << ' ';
  line << hex(frame);
  return line.str();
}

void tables() {
  for (const MessageInfo& info : message_infos()) {
    std::cout << info.name << ' ' << info.id << ' ' << int(info.crc_extra) << ' '
              << int(info.longest);
    for (const FieldInfo& field : info) {
      std::cout << ' ' << field.name << ':' << name(field.type) << ':' << int(field.count) << ':'
                << int(field.offset) << ':' << int(field.extension);
    }
    std::cout << '\n';
  }
}

std::string line_of(const Packet& packet) {
  return line_of(packet, encode(packet.message, packet.envelope).bytes());
}

std::string line_of(const Packet& packet, const SigningStamp& stamp, const SigningKey& key) {
  return line_of(packet, signed_frame(packet.message, packet.envelope, stamp, key).bytes());
}

using Key = std::optional<SigningKey>;

void write(int count, const Key& key) {
  test::Random random("peer");
  for (const MessageInfo& info : message_infos()) {
    for (int i = 0; i < count; ++i) {
      const Packet packet{test::random_envelope(random), test::random_message(info, random)};
      const std::uint64_t high = std::uint64_t(random.integer(0, 0xFFFF)) << 32;
      const SigningStamp stamp{test::random_byte(random), high | test::random_bits(random)};
      std::cout << (key ? line_of(packet, stamp, *key) : line_of(packet)) << '\n';
    }
  }
}

std::string line_of(Bytes frame, const Key& key) {
  const Decoded decoded = decode(frame);
  const auto* packet = std::get_if<Packet>(&decoded.content);
  if (packet == nullptr) return name(std::get<Refusal>(decoded.content));
  if (!key) return line_of(*packet);
  const FrameView view{frame, nullptr};
  return signature_matches(view, *key) ? line_of(*packet, signing_stamp(view), *key) : "forged";
}

void read(const Key& key) {
  for (std::string line; std::getline(std::cin, line);) {
    const test::Buffer frame = bytes_of(line);
    std::cout << line_of(test::view(frame), key) << '\n';
  }
}

Key key_of(const char* hex_text) {
  SigningKey::Secret secret{};
  const test::Buffer bytes = bytes_of(hex_text);
  std::copy_n(bytes.begin(), std::min(bytes.size(), secret.size()), secret.begin());
  return SigningKey(secret);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string verb = argc > 1 ? argv[1] : "";
  if (verb == "tables" && argc == 2) {
    tables();
  } else if (verb == "write" && (argc == 3 || argc == 4)) {
    write(std::atoi(argv[2]), argc == 4 ? key_of(argv[3]) : std::nullopt);
  } else if (verb == "read" && (argc == 2 || argc == 3)) {
    read(argc == 3 ? key_of(argv[2]) : std::nullopt);
  } else {
    return 2;
  }
  return 0;
}
