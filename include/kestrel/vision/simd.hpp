#pragma once

namespace kestrel {

/// Which instructions the inner loops use. Both give the same bits.
enum class Simd {
  Auto,      // AVX2 where the machine has it
  Baseline,  // what every x86-64 has
};

/// True when this machine's AVX2 is to be used.
bool use_avx2(Simd simd);

}  // namespace kestrel
