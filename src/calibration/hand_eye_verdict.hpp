#pragma once

#include "kestrel/calibration/hand_eye.hpp"

namespace kestrel {

/// Adds what speaks against the stations alone: too few, or turned about one axis only
/// (result.spread_rad).
void judge_stations(std::size_t count, HandEyeResult& result, const HandEyeOptions& options);

/// Adds what speaks against the answer: residuals too large, numbers too uncertain.
void judge_answer(HandEyeResult& result, const HandEyeOptions& options);

}  // namespace kestrel
