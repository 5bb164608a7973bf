// The stories of the fuzzers, by chance instead of by coverage: the oracle ends the program.
#include <gtest/gtest.h>

#include "fuzz/stories.hpp"
#include "samples.hpp"
#include "support/random.hpp"

namespace kestrel {
namespace {

TEST(SwitchStory, OfAnyBytesPassesNothingWrong) {
  test::Random random("raw story");
  for (int i = 0; i < 150; ++i) {
    test::Buffer bytes;
    for (int k = 0; k < 10; ++k) {
      const test::Buffer frame = test::random_frame(random);
      bytes.push_back(test::random_byte(random));
      bytes.push_back(std::uint8_t(frame.size()));
      bytes.push_back(std::uint8_t(frame.size() > 255 ? 1 : 0));
      bytes.insert(bytes.end(), frame.begin(), frame.end());
      bytes.push_back(test::random_byte(random));
    }
    fuzz::tell_raw_story(test::view(bytes));
  }
}

TEST(SwitchStory, OfWellBuiltFramesPassesNothingWrong) {
  test::Random random("built story");
  for (int i = 0; i < 150; ++i) {
    test::Buffer bytes(std::size_t(random.integer(10, 2000)));
    for (auto& byte : bytes) byte = test::random_byte(random);
    fuzz::tell_built_story(test::view(bytes));
  }
}

}  // namespace
}  // namespace kestrel
