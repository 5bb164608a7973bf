#include "fuzz/stories.hpp"

namespace kestrel::fuzz {

std::uint8_t Choices::byte() {
  if (bytes_.size == 0) return 0;
  const std::uint8_t value = bytes_.data[0];
  bytes_ = bytes_.after(1);
  return value;
}

std::uint32_t Choices::word() {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | byte();
  return value;
}

Bytes Choices::take(std::size_t count) {
  const Bytes taken = bytes_.first(count);
  bytes_ = bytes_.after(count);
  return taken;
}

void tell_raw_story(Bytes bytes) {
  Choices choices(bytes);
  WatchedSwitch watched;
  for (std::size_t link = 0; link < kWatchedLinks; ++link) watched.connect(PeerId(link + 1), link);
  while (choices.are_left()) {
    const PeerId peer = 1 + choices.pick(kWatchedLinks);
    const std::size_t size = choices.byte() + 256U * choices.pick(3);
    watched.receive(peer, choices.take(size));
    watched.pass(0.001 * choices.byte());
    watched.tick();
  }
  watched.pass(1);
  watched.tick();
}

}  // namespace kestrel::fuzz
