// Kestrel's codec for a peer that is another program (tests/link/peer).
//   peer_codec tables        what is known of each message, one a line: name, id, CRC_EXTRA, length
//                            with extensions, and of each field name:type:count:offset:extension
//   peer_codec write COUNT   writes COUNT random messages of each kind, one a line: name, system,
//                            component, sequence, a word for each field, frame
//   peer_codec read          reads frames, one a line, and for each writes a line like that: what
//   it
//                            decodes from the frame, and the frame it encodes from that
// A field's word: its elements in decimal, joined by commas; floats as their bits, characters as
// bytes. Frames are in hexadecimal.
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

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

std::string line_of(const Packet& packet) {
  const MessageInfo& info = info_of(packet.message);
  const test::Buffer payload = test::fields(packet.message);
  std::ostringstream line;
  line << info.name << ' ' << int(packet.envelope.system_id) << ' '
       << int(packet.envelope.component_id) << ' ' << int(packet.envelope.sequence) << ' ';
  for (const FieldInfo& field : info) line << word_of(field, payload) << ' ';
  line << hex(encode(packet.message, packet.envelope).bytes());
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

void write(int count) {
  test::Random random("peer");
  for (const MessageInfo& info : message_infos()) {
    for (int i = 0; i < count; ++i) {
      const Message message = test::random_message(info, random);
      std::cout << line_of({test::random_envelope(random), message}) << '\n';
    }
  }
}

void read() {
  for (std::string line; std::getline(std::cin, line);) {
    const test::Buffer frame = bytes_of(line);
    const Decoded decoded = decode(test::view(frame));
    if (const auto* packet = std::get_if<Packet>(&decoded.content)) {
      std::cout << line_of(*packet) << '\n';
    } else {
      std::cout << name(std::get<Refusal>(decoded.content)) << '\n';
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string verb = argc > 1 ? argv[1] : "";
  if (verb == "tables" && argc == 2) {
    tables();
  } else if (verb == "write" && argc == 3) {
    write(std::atoi(argv[2]));
  } else if (verb == "read" && argc == 2) {
    read();
  } else {
    return 2;
  }
  return 0;
}
