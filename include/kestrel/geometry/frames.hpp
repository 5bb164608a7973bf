#pragma once

#include <type_traits>

/// Tags that name a coordinate frame in a type. They are never objects.
namespace kestrel::frame {

/// Camera optical frame: x right, y down, z forward (ViSP: c).
struct Camera {};
/// Helicopter frame: x forward, y right, z down (FRD).
struct Body {};
/// Template plane: origin at its centre, x right, y down, z away from the viewer (ViSP: o).
struct Target {};
/// Local level earth frame: x north, y east, z down (NED).
struct World {};

/// True for two frames that do not move against each other: only between such frames does a
/// transform carry a twist over.
template <class A, class B>
inline constexpr bool kRigid = std::is_same_v<A, B>;
template <>
inline constexpr bool kRigid<Camera, Body> = true;
template <>
inline constexpr bool kRigid<Body, Camera> = true;

}  // namespace kestrel::frame
