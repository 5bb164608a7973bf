#include "fuzz/stories.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kestrel::fuzz::tell_built_story({data, size});
  return 0;
}
