#pragma once

#include <cstdint>
#include <optional>

namespace kestrel {

/// How old what a sender stamps is, when nobody has told how its clock stands to ours: the frame
/// that took the shortest way so far counts as fresh, and every other is older by what its way took
/// longer. So a constant delay is not seen; a delay that grows, a queue, and a stamp that stands
/// still are. The shortest way is forgotten by kDrift, as two quartz clocks go apart.
class SenderClock {
 public:
  static constexpr double kDrift = 2e-4;  // s per s: two clocks of 100 ppm each

  /// Seconds since the capture, by what is known: 0 for the first frame; negative when the stamp is
  /// later than any delay can explain. Stamps are modulo 2^32 ms, compared within 24 days.
  double age_s(std::uint32_t time_boot_ms, double now_s) const;

  /// Takes the frame for true: when its way was the shortest, it becomes the measure.
  void learn(std::uint32_t time_boot_ms, double now_s);

 private:
  struct Shortest {
    std::uint32_t time_boot_ms = 0;
    double arrived_s = 0;
  };
  std::optional<Shortest> shortest_;
};

/// a - b of stamps modulo 2^32 ms, in seconds: -2^31 to 2^31 ms.
double stamp_difference_s(std::uint32_t a_ms, std::uint32_t b_ms);

}  // namespace kestrel
