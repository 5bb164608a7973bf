#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kestrel/ground/ground_station.hpp"
#include "kestrel/ground/replay_run.hpp"
#include "kestrel/ground/run_pictures.hpp"

namespace kestrel {

/// A run and its pictures.
struct Recording {
  ReplayRun run;
  RunPictures pictures;
};

/// Recorded runs in the ground station's page: the page asks for the frames it shows, in the
/// stream's own format, so each viewer plays at its own pace. No command is taken.
class ReplayStation {
 public:
  /// The most runs shown beside each other.
  static constexpr std::size_t kMaxRuns = 2;
  /// The most frames in one answer.
  static constexpr long kMaxFrames = 64;

  /// Listens when this returns. Throws std::invalid_argument for no run or more than kMaxRuns, and
  /// as GroundStation.
  ReplayStation(const GroundOptions& options, const AccessToken& token,
                std::vector<Recording> recordings);
  ~ReplayStation();
  ReplayStation(const ReplayStation&) = delete;
  ReplayStation& operator=(const ReplayStation&) = delete;

  std::uint16_t port() const;
  /// See GroundStation::address.
  std::string address() const;
  GroundRefusals refusals() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kestrel
