#include "kestrel/link/control_word.hpp"

#include <gtest/gtest.h>

namespace kestrel {
namespace {

TEST(ControlWord, GoesIntoBitsAndBack) {
  for (std::uint32_t state = 0; state <= std::uint32_t(ControlState::Stopped); ++state) {
    for (std::uint32_t owner = 0; owner <= kLinkRoles; ++owner) {
      ControlWord word{ControlState(state), std::nullopt};
      if (owner > 0) word.owner = LinkRole(owner - 1);
      const auto back = control_word(bits_of(word));
      ASSERT_TRUE(back) << state << ' ' << owner;
      EXPECT_EQ(back->state, word.state);
      EXPECT_EQ(back->owner, word.owner);
    }
  }
}

TEST(ControlWord, TheStateIsTheLowestByte) {
  // Who reads the state alone, as it was before the owner stood beside it, reads it still.
  EXPECT_EQ(bits_of({ControlState::Stopped, std::nullopt}), 5u);
  EXPECT_EQ(bits_of({ControlState::Owned, LinkRole::Vision}) & 0xFF, 2u);
}

TEST(ControlWord, NonsenseIsNone) {
  EXPECT_FALSE(control_word(6));
  EXPECT_FALSE(control_word(2 | 6 << 8));
  EXPECT_FALSE(control_word(0xFFFFFFFF));
}

TEST(ControlWord, SaysWhoCommands) {
  EXPECT_EQ(words(ControlWord{ControlState::Owned, LinkRole::Vision}),
            "vision commands the vehicle");
  EXPECT_EQ(words(ControlWord{ControlState::TakenOver, std::nullopt}),
            "taken over by the ground: nobody commands the vehicle: zeros");
  EXPECT_EQ(words(ControlWord{ControlState::Stopped, LinkRole::Ground}),
            "EMERGENCY STOP: zeros until it is reset");
}

}  // namespace
}  // namespace kestrel
