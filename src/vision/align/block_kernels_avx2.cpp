#include "block_kernels.hpp"

#define KERNEL(name) name##_avx2
#include "block_kernels.inl"
