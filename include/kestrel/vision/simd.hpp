#pragma once

namespace kestrel {

/// Which vector kernels run. Both give the same bits: the same operations in the same order, none
/// contracted; Baseline is there to prove it and for processors without AVX2.
enum class Simd {
  Auto,      // AVX2 where the processor has it
  Baseline,  // SSE2, what every x86-64 has
};

/// Whether kernels asked for like this run with AVX2 on this processor.
bool use_avx2(Simd simd);

}  // namespace kestrel
