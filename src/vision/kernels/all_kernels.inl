// The kernels of one instruction set, in a namespace of its own.
#include "lanes.inl"
// (in this order)
#include "blur.inl"
#include "extrema.inl"
#include "orientation.inl"
#include "descriptor.inl"
#include "distance.inl"

namespace kestrel::kernels::KESTREL_KERNELS {

constexpr Table kTable{widen, halve, blur, find_extrema, orientations, describe, compare, nearest};

}  // namespace kestrel::kernels::KESTREL_KERNELS
