#pragma once

#include <optional>
#include <string>

#include <opencv2/core/types.hpp>

namespace kestrel {

/// What starts each picture of a FireWire camera in place of its own clock (IIDC's TRIGGER_MODE
/// register).
struct TriggerSettings {
  std::string source = "0";  // an input of the camera, "0" to "3", or "software": this program
  int mode = 0;          // 0: an edge starts the exposure; 1: it lasts as long as the level; ...
  std::string polarity;  // "high" or "low": the active level; empty: as the camera has it
};

/// What a camera is asked to deliver; what is absent is left to the camera, or to the choice that
/// choose_mode makes.
struct CaptureSettings {
  std::string format;                      // a name of CameraMode::format; empty: any that is read
  std::optional<cv::Size> size;            // px
  std::optional<double> rate_hz;           // pictures per second, at least
  std::optional<double> exposure_s;        // shutter time, with the automatic exposure off
  std::optional<double> gain;              // in the camera's own unit, with the automatic gain off
  std::optional<TriggerSettings> trigger;  // of dc1394 only; absent: pictures at the rate

  /// True when nothing is asked for.
  bool is_empty() const;
};

/// How a live camera is opened, and how long it may keep the program waiting.
struct LiveOptions {
  CaptureSettings capture;
  double open_timeout_s = 10;  // for the first picture of all
  double stall_timeout_s = 2;  // without a picture the connection counts as lost and is made anew
  double blind_s = 0.25;       // without a picture the loop is told, ten times a second
  double give_up_s = 60;       // without a picture the source has failed
  double retry_s = 0.25;       // before the first attempt to connect again; doubles each time
  double longest_retry_s = 4;  // up to this
  std::size_t queue_pictures = 1;  // kept while nobody takes them; the oldest goes first

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// How long to wait before attempt k (0, 1, ...) to connect again, s: retry_s 2^k, at most
/// longest_retry_s.
double retry_delay_s(int attempt, const LiveOptions& options);

}  // namespace kestrel
