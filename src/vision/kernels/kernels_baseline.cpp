#include <immintrin.h>

#include "kernels.hpp"

#define KESTREL_KERNELS baseline
#include "all_kernels.inl"
#undef KESTREL_KERNELS

namespace kestrel::kernels {

const Table& baseline_table() { return baseline::kTable; }

}  // namespace kestrel::kernels
