#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {

/// One way for pictures to come: what sends them, over what.
struct StreamWay {
  std::string name;
  std::string address;                          // as a source
  std::function<Command(int width_px)> sender;  // 25 pictures a second of this width, 4 to 3
  /// Opens what stands between sender and viewer, where something does, as long as it lives.
  std::function<std::shared_ptr<void>()> server = [] { return nullptr; };
  bool serves_once = false;  // the sender ends when it has lost its viewer
};

/// FFmpeg and GStreamer over every protocol that they send; ports are free ones. Files are written
/// into the folder.
std::vector<StreamWay> stream_ways(const TempFolder& folder);

/// How many there are.
inline constexpr int kStreamWays = 11;

}  // namespace kestrel::test
