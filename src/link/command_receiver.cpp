#include "kestrel/link/command_receiver.hpp"

#include <optional>

namespace kestrel {

CommandReceiver::CommandReceiver(const Address& at, const Recipient& me)
    : socket_(UdpSocket::bound_to(at)), state_(me) {}

std::vector<ReceivedCommand> CommandReceiver::poll(double timeout_s) {
  constexpr int kMaxDatagrams = 256;
  std::vector<ReceivedCommand> commands;
  std::optional<Datagram> datagram = socket_.receive(timeout_s);
  for (int i = 1; datagram; ++i) {
    const std::vector<ReceivedCommand> more = state_.take(datagram->bytes, datagram->from);
    commands.insert(commands.end(), more.begin(), more.end());
    if (i == kMaxDatagrams) break;
    datagram = socket_.receive(0);
  }
  return commands;
}

}  // namespace kestrel
