#include "kestrel/link/token_bucket.hpp"

#include <algorithm>
#include <cmath>

namespace kestrel {

bool TokenBucket::take(double now_s) {
  if (!started_ && std::isfinite(now_s)) {
    started_ = true;
    filled_s_ = now_s;
  }
  if (std::isfinite(now_s) && now_s > filled_s_) {
    tokens_ = std::min(limit_.burst, tokens_ + limit_.frames_per_s * (now_s - filled_s_));
    filled_s_ = now_s;
  }
  if (tokens_ < 1) return false;
  tokens_ -= 1;
  return true;
}

}  // namespace kestrel
