// Kestrel's codec for a peer that is another program (tests/link/peer).
//   peer_codec write COUNT   writes COUNT random messages, half of each kind, one a line:
//                            name, system, component, sequence, fields (floats as bits), frame
//   peer_codec read          reads lines like that, and for each writes a line of its own: what it
//                            decodes from the frame, and the frame it encodes from that
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

std::string line_of(const Packet& packet) {
  std::ostringstream line;
  line << info_of(packet.message).name << ' ' << int(packet.envelope.system_id) << ' '
       << int(packet.envelope.component_id) << ' ' << int(packet.envelope.sequence) << ' '
       << std::hex << std::setfill('0');
  for (const std::uint8_t byte : test::copy(encode(packet.message, packet.envelope).bytes())) {
    line << std::setw(2) << int(byte);
  }
  return line.str();
}

test::Buffer frame_of(const std::string& line) {
  const std::string hex = line.substr(line.rfind(' ') + 1);
  test::Buffer frame;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    frame.push_back(std::uint8_t(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return frame;
}

void write(int count) {
  test::Random random("peer");
  for (int i = 0; i < count; ++i) {
    std::cout << line_of({test::random_envelope(random), test::random_message(random)}) << '\n';
  }
}

void read() {
  for (std::string line; std::getline(std::cin, line);) {
    const Decoded decoded = decode(test::view(frame_of(line)));
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
  if (verb == "write" && argc == 3) {
    write(std::atoi(argv[2]));
  } else if (verb == "read" && argc == 2) {
    read();
  } else {
    return 2;
  }
  return 0;
}
