#pragma once

#include "kestrel/link/switch_options.hpp"

namespace kestrel {

/// What keeps a peer within its rate: it fills by frames_per_s up to burst, and each frame takes
/// one. In any span of d seconds it gives at most burst + frames_per_s * d.
class TokenBucket {
 public:
  /// Full.
  explicit TokenBucket(const FlowLimit& limit) : limit_(limit), tokens_(limit.burst) {}

  /// True when there is one to take, and then it is taken. A clock that does not go on, or is not
  /// finite, fills nothing.
  bool take(double now_s);

 private:
  FlowLimit limit_;
  double tokens_;
  double filled_s_ = 0;  // when
  bool started_ = false;
};

}  // namespace kestrel
