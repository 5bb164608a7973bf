#pragma once

#include "kestrel/link/frame_place.hpp"

#include "owned_descriptor.hpp"

/// What the two ends of a stream of frames share.
namespace kestrel {

/// Listens there, without blocking. Throws std::runtime_error.
OwnedDescriptor listen_for_frames(const FramePlace& at, int waiting);

/// The place of a descriptor that listens at `at`, with its real port.
FramePlace place_of(int descriptor, const FramePlace& at);

/// A connection to who serves frames there; it does not block. Throws std::runtime_error when it
/// does not come about within timeout_s.
OwnedDescriptor connect_for_frames(const FramePlace& to, double timeout_s);

/// Whole frames go at once, few wait in the kernel, and an end that is gone is noticed.
void prepare_for_frames(int descriptor);

}  // namespace kestrel
