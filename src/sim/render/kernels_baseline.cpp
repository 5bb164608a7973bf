#include <immintrin.h>

#include "kernels.hpp"

#define KERNEL(name) name##_baseline
#include "kernels.inl"
