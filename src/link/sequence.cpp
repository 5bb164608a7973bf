#include "kestrel/link/sequence.hpp"

namespace kestrel {
namespace {

constexpr unsigned kWindow = 64;  // bits of the masks

std::uint64_t shifted(std::uint64_t mask, unsigned count) {
  return count < kWindow ? mask << count : 0;
}

}  // namespace

Arrival SequenceWindow::arrive(std::uint8_t sequence) {
  if (!started_) {
    started_ = true;
    newest_ = sequence;
    seen_ = 1;
    return Arrival::New;
  }
  const unsigned behind = std::uint8_t(newest_ - sequence);
  if (behind >= kWindow) {
    const unsigned ahead = 256 - behind;
    const std::uint64_t skipped = ~shifted(~std::uint64_t{0}, ahead) & ~std::uint64_t{1};
    newest_ = sequence;
    seen_ = shifted(seen_, ahead) | 1;
    missing_ = shifted(missing_, ahead) | skipped;
    lost_ += long(ahead) - 1;
    return Arrival::New;
  }
  const std::uint64_t bit = std::uint64_t{1} << behind;
  if ((seen_ & bit) != 0) return Arrival::Duplicate;
  if ((missing_ & bit) != 0) --lost_;
  seen_ |= bit;
  missing_ &= ~bit;
  return Arrival::Late;
}

}  // namespace kestrel
