#include <immintrin.h>

#include "kernels.hpp"

#define KERNEL(name) name##_avx2
#include "kernels.inl"
