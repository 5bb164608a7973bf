// A stand-in for libdc1394, preloaded in front of it: one camera that sends frames, and the faults
// that the environment variable KESTREL_DC1394_FAULT names. It proves how Kestrel uses the library,
// not the bus.
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>

#include <dc1394/dc1394.h>

namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 480;
unsigned char g_pixels[kWidth * kHeight * 6];  // NOLINT
dc1394video_frame_t g_frame;                   // NOLINT
dc1394camera_t g_camera;                       // NOLINT
int g_bus;                                     // NOLINT
int g_taken;                                   // NOLINT
int g_out;                                     // NOLINT
float g_shutter_s;                             // NOLINT
float g_gain;                                  // NOLINT
dc1394framerate_t g_rate;                      // NOLINT
dc1394switch_t g_waits = DC1394_ON;            // NOLINT: as another program left it
dc1394trigger_source_t g_source;               // NOLINT
dc1394trigger_mode_t g_mode;                   // NOLINT
int g_polarity = -1;                           // NOLINT
int g_asked;                                   // NOLINT: by software, not yet answered

std::uint64_t now_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::uint64_t(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

bool fault(const char* name) {
  const char* set = std::getenv("KESTREL_DC1394_FAULT");
  return set != nullptr && std::strcmp(set, name) == 0;
}

/// The coding of the camera's only mode, Format7, that the environment variable
/// KESTREL_DC1394_CODING names by the library's number; -1 when it names none.
int only_coding() {
  const char* set = std::getenv("KESTREL_DC1394_CODING");
  return set != nullptr ? std::atoi(set) : -1;
}

/// Of pixel i of a row: bright, and of colourful U and V.
constexpr int kU = 200;
constexpr int kV = 60;
unsigned char luma(int i, bool striped) {
  return static_cast<unsigned char>(g_taken + (striped ? 10 * (i % 4) : 0));
}

/// Frame g_taken in the coding: the brightness grows by 10 from a pixel to the next, four times
/// over, but for raw pictures, whose pixels are all alike.
void fill(int coding) {
  const bool is_raw = coding == DC1394_COLOR_CODING_RAW8 || coding == DC1394_COLOR_CODING_RAW16;
  unsigned char* to = g_pixels;
  for (int i = 0; i < int(kWidth * kHeight); ++i) {
    const unsigned char y = luma(i, !is_raw);
    if (coding == DC1394_COLOR_CODING_YUV411 && i % 2 == 0) *to++ = i % 4 == 0 ? kU : kV;
    if (coding == DC1394_COLOR_CODING_YUV422) *to++ = i % 2 == 0 ? kU : kV;
    if (coding == DC1394_COLOR_CODING_YUV444) *to++ = kU;
    const bool is_rgb = coding == DC1394_COLOR_CODING_RGB8 || coding == DC1394_COLOR_CODING_RGB16;
    const bool is_wide = coding == DC1394_COLOR_CODING_MONO16 ||
                         coding == DC1394_COLOR_CODING_RGB16 || coding == DC1394_COLOR_CODING_RAW16;
    for (int channel = 0; channel < (is_rgb ? 3 : 1); ++channel) {
      if (is_wide) *to++ = y >> 4;  // 12 of 16 bits, the upper byte first
      *to++ = is_wide ? static_cast<unsigned char>(y << 4) : y;
    }
    if (coding == DC1394_COLOR_CODING_YUV444) *to++ = kV;
  }
  g_frame.stride = std::uint32_t(to - g_pixels) / kHeight;
  g_frame.data_depth = 12;
}

}  // namespace

extern "C" {

/// Frames that were taken and not given back; also says that the stand-in is there.
int kestrel_dc1394_frames_out() { return g_out; }
/// What was set.
float kestrel_dc1394_shutter_s() { return g_shutter_s; }
float kestrel_dc1394_gain() { return g_gain; }
int kestrel_dc1394_rate() { return g_rate; }
/// Power, source, mode, polarity of the trigger as the library numbers them.
int kestrel_dc1394_trigger_power() { return g_waits; }
int kestrel_dc1394_trigger_source() { return g_source; }
int kestrel_dc1394_trigger_mode() { return g_mode; }
int kestrel_dc1394_trigger_polarity() { return g_polarity; }

dc1394_t* dc1394_new() {
  g_taken = g_out = 0;
  return fault("no_bus") ? nullptr : reinterpret_cast<dc1394_t*>(&g_bus);
}
void dc1394_free(dc1394_t*) {}
dc1394error_t dc1394_camera_enumerate(dc1394_t*, dc1394camera_list_t** list) {
  *list = new dc1394camera_list_t{fault("no_camera") ? 0u : 1u,
                                  new dc1394camera_id_t{0, 0x0123456789abcdefULL}};
  return DC1394_SUCCESS;
}
void dc1394_camera_free_list(dc1394camera_list_t* list) {
  delete list->ids;
  delete list;
}
dc1394camera_t* dc1394_camera_new(dc1394_t*, uint64_t guid) {
  static char vendor[] = "Stand-in";
  static char model[] = "IIDC";
  g_camera.guid = guid;
  g_camera.vendor = vendor;
  g_camera.model = model;
  return &g_camera;
}
void dc1394_camera_free(dc1394camera_t*) {}
dc1394error_t dc1394_video_set_iso_speed(dc1394camera_t*, dc1394speed_t) { return DC1394_SUCCESS; }
dc1394error_t dc1394_video_get_supported_modes(dc1394camera_t*, dc1394video_modes_t* modes) {
  modes->num = 2;
  modes->modes[0] = DC1394_VIDEO_MODE_640x480_YUV411;
  modes->modes[1] = fault("odd_modes") ? DC1394_VIDEO_MODE_EXIF : DC1394_VIDEO_MODE_640x480_MONO8;
  if (fault("odd_modes")) modes->modes[0] = DC1394_VIDEO_MODE_EXIF;
  if (fault("format7") || only_coding() >= 0) {
    modes->num = 1;
    modes->modes[0] = DC1394_VIDEO_MODE_FORMAT7_0;
  }
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_max_image_size(dc1394camera_t*, dc1394video_mode_t,
                                                uint32_t* width, uint32_t* height) {
  *width = kWidth;
  *height = kHeight;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_color_codings(dc1394camera_t*, dc1394video_mode_t,
                                               dc1394color_codings_t* codings) {
  codings->num = 2;
  codings->codings[0] = DC1394_COLOR_CODING_MONO16S;
  codings->codings[1] = DC1394_COLOR_CODING_RAW8;
  if (only_coding() >= 0) {
    codings->num = 1;
    codings->codings[0] = dc1394color_coding_t(only_coding());
  }
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_set_roi(dc1394camera_t*, dc1394video_mode_t,
                                     dc1394color_coding_t coding, int32_t packet, int32_t left,
                                     int32_t top, int32_t width, int32_t height) {
  const bool is_whole = left == 0 && top == 0 && width == int(kWidth) && height == int(kHeight);
  g_frame.color_coding = coding;
  return is_whole && packet == DC1394_USE_MAX_AVAIL ? DC1394_SUCCESS : DC1394_FAILURE;
}
dc1394error_t dc1394_format7_get_color_filter(dc1394camera_t*, dc1394video_mode_t,
                                              dc1394color_filter_t* pattern) {
  *pattern = DC1394_COLOR_FILTER_GRBG;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_is_present(dc1394camera_t*, dc1394feature_t, dc1394bool_t* present) {
  *present = fault("no_trigger_feature") ? DC1394_FALSE : DC1394_TRUE;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_get(dc1394camera_t*, dc1394feature_info_t* info) {
  if (info->id != DC1394_FEATURE_TRIGGER) return DC1394_INVALID_FEATURE;
  info->polarity_capable = fault("fixed_polarity") ? DC1394_FALSE : DC1394_TRUE;
  info->trigger_modes = {2, {DC1394_TRIGGER_MODE_0, DC1394_TRIGGER_MODE_14}};
  info->trigger_sources = {2, {DC1394_TRIGGER_SOURCE_1, DC1394_TRIGGER_SOURCE_SOFTWARE}};
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_external_trigger_set_power(dc1394camera_t*, dc1394switch_t on) {
  g_waits = on;
  g_asked = 0;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_external_trigger_set_source(dc1394camera_t*, dc1394trigger_source_t source) {
  g_source = source;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_external_trigger_set_mode(dc1394camera_t*, dc1394trigger_mode_t mode) {
  g_mode = mode;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_external_trigger_set_polarity(dc1394camera_t*, dc1394trigger_polarity_t way) {
  g_polarity = way;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_software_trigger_set_power(dc1394camera_t*, dc1394switch_t on) {
  g_asked += on == DC1394_ON ? 1 : 0;
  return fault("no_software_trigger") ? DC1394_FAILURE : DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_set_mode(dc1394camera_t*, dc1394feature_t, dc1394feature_mode_t mode) {
  return mode == DC1394_FEATURE_MODE_MANUAL ? DC1394_SUCCESS : DC1394_FAILURE;
}
dc1394error_t dc1394_feature_set_absolute_control(dc1394camera_t*, dc1394feature_t,
                                                  dc1394switch_t on) {
  return on == DC1394_ON ? DC1394_SUCCESS : DC1394_FAILURE;
}
dc1394error_t dc1394_feature_set_absolute_value(dc1394camera_t*, dc1394feature_t feature,
                                                float value) {
  (feature == DC1394_FEATURE_SHUTTER ? g_shutter_s : g_gain) = value;
  return value < 100 ? DC1394_SUCCESS : DC1394_INVALID_FEATURE;
}
dc1394error_t dc1394_video_set_mode(dc1394camera_t*, dc1394video_mode_t mode) {
  g_frame.video_mode = mode;
  g_frame.color_coding = DC1394_COLOR_CODING_MONO8;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_get_supported_framerates(dc1394camera_t*, dc1394video_mode_t,
                                                    dc1394framerates_t* rates) {
  rates->num = 2;
  rates->framerates[0] = DC1394_FRAMERATE_30;
  rates->framerates[1] = DC1394_FRAMERATE_15;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_set_framerate(dc1394camera_t*, dc1394framerate_t rate) {
  g_rate = rate;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_capture_setup(dc1394camera_t*, uint32_t, uint32_t) {
  return fault("no_bandwidth") ? DC1394_NO_BANDWIDTH : DC1394_SUCCESS;
}
dc1394error_t dc1394_capture_stop(dc1394camera_t*) { return DC1394_SUCCESS; }
dc1394error_t dc1394_video_set_transmission(dc1394camera_t*, dc1394switch_t) {
  return DC1394_SUCCESS;
}
/// Frame k has grey value k and filled the bus 7 ms before it is taken. Every third call finds
/// nothing yet.
dc1394error_t dc1394_capture_dequeue(dc1394camera_t*, dc1394capture_policy_t policy,
                                     dc1394video_frame_t** frame) {
  static int calls = 0;
  *frame = nullptr;
  if (policy != DC1394_CAPTURE_POLICY_POLL) return DC1394_INVALID_CAPTURE_POLICY;
  if (fault("dequeue_error") && g_taken == 3) return DC1394_IOCTL_FAILURE;
  if (fault("bus_reset") && g_taken == 3) {
    ++g_taken;
    return DC1394_FAILURE;
  }
  if (fault("unplugged") && g_taken >= 3) return DC1394_SUCCESS;
  if (++calls % 3 == 0) return DC1394_SUCCESS;
  if (g_waits == DC1394_ON && fault("no_trigger")) return DC1394_SUCCESS;
  if (g_waits == DC1394_ON && g_source == DC1394_TRIGGER_SOURCE_SOFTWARE) {
    if (g_asked == 0) return DC1394_SUCCESS;
    if (g_asked > 1) return DC1394_IOCTL_FAILURE;  // asked for one before the last one came
    g_asked = 0;
  }
  g_frame.image = g_pixels;
  g_frame.size[0] = kWidth;
  g_frame.size[1] = kHeight;
  if (only_coding() >= 0) {
    fill(only_coding());
  } else {
    std::memset(g_pixels, g_taken, sizeof g_pixels);
    g_frame.stride = kWidth;
    g_frame.data_depth = 8;
  }
  g_frame.timestamp = now_us() - 7000;
  ++g_taken;
  ++g_out;
  *frame = &g_frame;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_capture_enqueue(dc1394camera_t*, dc1394video_frame_t*) {
  --g_out;
  return DC1394_SUCCESS;
}
dc1394bool_t dc1394_capture_is_frame_corrupt(dc1394camera_t*, dc1394video_frame_t*) {
  return fault("corrupt") && g_taken == 2 ? DC1394_TRUE : DC1394_FALSE;
}

}  // extern "C"
