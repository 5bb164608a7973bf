#include "block_kernels.hpp"

#define KERNEL(name) name##_baseline
#include "block_kernels.inl"
