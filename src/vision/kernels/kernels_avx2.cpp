#include <immintrin.h>

#include "kernels.hpp"

#define KESTREL_KERNELS avx2
#include "all_kernels.inl"
#undef KESTREL_KERNELS

namespace kestrel::kernels {

const Table& avx2_table() { return avx2::kTable; }

}  // namespace kestrel::kernels
