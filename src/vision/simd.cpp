#include "kestrel/vision/simd.hpp"

namespace kestrel {

bool use_avx2(Simd simd) { return simd == Simd::Auto && __builtin_cpu_supports("avx2") != 0; }

}  // namespace kestrel
