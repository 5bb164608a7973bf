#pragma once

#include <cstdio>

#include <gtest/gtest.h>

#include "link/switch_bench.hpp"

namespace kestrel::test {

/// What the tests of the fault table share: each bad input asks for a descent (or is no number),
/// which no good one ever does; so whatever reaches flight control with one is a wrong command.
class FaultTable : public testing::Test {
 protected:
  static constexpr PeerId kFlight = SwitchBench::kFlight;
  static constexpr PeerId kVision = SwitchBench::kVision;
  static constexpr PeerId kGround = SwitchBench::kGround;
  static constexpr PeerId kScript = SwitchBench::kScript;
  static constexpr PeerId kListener = SwitchBench::kListener;

  static constexpr VelocityCommand good() { return {0.5, 0.25, 0, 0.1}; }
  static constexpr VelocityCommand bad() { return {0.5, 0.25, 0.5, 0.1}; }

  /// Counts inputs that must not be obeyed.
  void try_bad(long inputs = 1) { tried_ += inputs; }

  /// Wrong commands at flight control on this bench; adds them to the sum.
  long count_wrong(SwitchBench& bench) {
    long wrong = 0;
    for (const SwitchBench::Heard& heard : bench.heard(kFlight)) {
      if (is_wrong(heard.bytes)) ++wrong;
    }
    passed_ += wrong;
    return wrong;
  }

  /// For flight control: not finite anywhere, unknown, or a descent.
  static bool is_wrong(const Buffer& bytes);

  static void TearDownTestSuite() {
    std::printf("bad inputs tried %ld, wrong commands passed %ld\n", tried_, passed_);
    EXPECT_EQ(passed_, 0);
  }

  SwitchBench bench_;

 private:
  static inline long tried_ = 0;
  static inline long passed_ = 0;
};

inline bool FaultTable::is_wrong(const Buffer& bytes) {
  const mavlink::Parsed parsed = mavlink::parse(view(bytes));
  const auto* frame = std::get_if<mavlink::FrameView>(&parsed.content);
  if (frame == nullptr || frame->info == nullptr || parsed.size != bytes.size()) return true;
  Buffer payload = copy(frame->payload());
  payload.resize(mavlink::kMaxPayload);  // trailing zeros are not sent
  for (const mavlink::FieldInfo& field : *frame->info) {
    if (field.type != mavlink::FieldType::Float) continue;
    for (std::size_t i = 0; i < field.size(); i += 4) {
      std::uint32_t bits = 0;
      for (std::size_t k = 4; k-- > 0;) bits = bits << 8 | payload[field.offset + i + k];
      if ((bits & 0x7F800000) == 0x7F800000) return true;
    }
  }
  const auto message = mavlink::message_of(frame->info->id, frame->payload());
  const auto* s = std::get_if<mavlink::SetPositionTarget>(&*message);
  return s != nullptr && s->vz_m_s != 0;
}

}  // namespace kestrel::test
