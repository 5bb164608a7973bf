#pragma once

#include <chrono>
#include <cstdlib>
#include <cstring>

#include <dc1394/dc1394.h>

/// What the parts of the stand-in for libdc1394 share: its one camera, and the fault that is set.
namespace kestrel::test::dc1394 {

inline constexpr std::uint32_t kWidth = 640;
inline constexpr std::uint32_t kHeight = 480;
inline unsigned char g_pixels[kWidth * kHeight * 6];  // NOLINT
inline dc1394video_frame_t g_frame;                   // NOLINT
inline dc1394camera_t g_camera;                       // NOLINT
inline int g_bus;                                     // NOLINT
inline int g_taken;                                   // NOLINT
inline int g_out;                                     // NOLINT
inline float g_shutter_s;                             // NOLINT
inline float g_gain;                                  // NOLINT
inline dc1394framerate_t g_rate;                      // NOLINT
inline dc1394switch_t g_waits = DC1394_ON;            // NOLINT: as another program left it
inline dc1394trigger_source_t g_source;               // NOLINT
inline dc1394trigger_mode_t g_mode;                   // NOLINT
inline dc1394speed_t g_speed;                         // NOLINT
inline int g_polarity = -1;                           // NOLINT
inline int g_asked;                                   // NOLINT: by software, not yet answered
inline const unsigned char* g_shown;  // NOLINT: the pixels of every frame; none: all alike
inline int g_period_ms;               // NOLINT: between frames

inline std::uint64_t now_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::uint64_t(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

inline bool fault(const char* name) {
  const char* set = std::getenv("KESTREL_DC1394_FAULT");
  return set != nullptr && std::strcmp(set, name) == 0;
}

/// The coding of the camera's only mode, Format7, that the environment variable
/// KESTREL_DC1394_CODING names by the library's number; -1 when it names none.
inline int only_coding() {
  const char* set = std::getenv("KESTREL_DC1394_CODING");
  return set != nullptr ? std::atoi(set) : -1;
}

}  // namespace kestrel::test::dc1394
