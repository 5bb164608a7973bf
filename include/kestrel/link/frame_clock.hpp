#pragma once

#include <optional>

namespace kestrel {

/// A sender's clock against ours, by the frames it sends alone: each tells when it left, and the
/// one that took the shortest way counts. So what is dated is late by the shortest way at most (far
/// below a millisecond on one machine), and no queue on the way makes a frame look younger. The
/// shortest way is forgotten by kDrift, as two quartz clocks go apart.
class FrameClock {
 public:
  static constexpr double kDrift = 2e-4;  // s per s: two clocks of 100 ppm each

  /// A frame that left at sent_s of the sender's clock arrived at arrived_s of ours.
  void learn(double sent_s, double arrived_s);

  /// A time of the sender's clock on ours; empty before the first frame.
  std::optional<double> ours(double theirs_s) const;

 private:
  struct Shortest {
    double ahead_s = 0;  // our clock minus the sender's, way included
    double learned_s = 0;
  };
  std::optional<Shortest> shortest_;
};

}  // namespace kestrel
