// A stand-in for libdc1394, preloaded in front of it: one camera that sends frames, and the faults
// that the environment variable KESTREL_DC1394_FAULT names. It proves how Kestrel uses the library,
// not the bus.
#include "io/dc1394_standin.hpp"

using namespace kestrel::test::dc1394;  // NOLINT: the library's own names stand at the top

namespace {

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
/// The pixels of every frame, 640x480, and the time between them; null: frame k is all of k.
void kestrel_dc1394_show(const unsigned char* pixels, int period_ms) {
  g_shown = pixels;
  g_period_ms = period_ms;
}
dc1394_t* dc1394_new() {
  g_taken = g_out = 0;
  return fault("no_bus") || fault("bus_gone") ? nullptr : reinterpret_cast<dc1394_t*>(&g_bus);
}
void dc1394_free(dc1394_t*) {}
dc1394error_t dc1394_camera_enumerate(dc1394_t*, dc1394camera_list_t** list) {
  *list = new dc1394camera_list_t{fault("no_camera") || fault("camera_gone") ? 0u : 1u,
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
  g_camera.bmode_capable = fault("b_mode") || fault("no_800") ? DC1394_TRUE : DC1394_FALSE;
  g_camera.vendor = vendor;
  g_camera.model = model;
  return &g_camera;
}
void dc1394_camera_free(dc1394camera_t*) {}
dc1394error_t dc1394_capture_setup(dc1394camera_t*, uint32_t, uint32_t) {
  return fault("no_bandwidth") ? DC1394_NO_BANDWIDTH : DC1394_SUCCESS;
}
dc1394error_t dc1394_capture_stop(dc1394camera_t*) { return DC1394_SUCCESS; }
dc1394error_t dc1394_video_set_transmission(dc1394camera_t*, dc1394switch_t) {
  return DC1394_SUCCESS;
}
/// Frame k has grey value k and filled the bus 7 ms before it is taken; what is shown instead, at
/// once. Every third call finds
/// nothing yet.
dc1394error_t dc1394_capture_dequeue(dc1394camera_t*, dc1394capture_policy_t policy,
                                     dc1394video_frame_t** frame) {
  static int calls = 0;
  *frame = nullptr;
  if (policy != DC1394_CAPTURE_POLICY_POLL) return DC1394_INVALID_CAPTURE_POLICY;
  const bool fails = fault("dequeue_error") || fault("bus_gone") || fault("camera_gone");
  if (fails && g_taken >= 3) return DC1394_IOCTL_FAILURE;
  if (fault("no_dequeue")) return DC1394_IOCTL_FAILURE;
  if (fault("bus_reset") && g_taken >= 3) return DC1394_FAILURE;
  if (fault("unplugged") && g_taken >= 3) return DC1394_SUCCESS;
  static std::uint64_t last_us = 0;
  if (now_us() - last_us < 1000u * std::uint64_t(g_period_ms)) return DC1394_SUCCESS;
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
    if (g_shown != nullptr) std::memcpy(g_pixels, g_shown, kWidth * kHeight);
    if (g_shown == nullptr) std::memset(g_pixels, g_taken, sizeof g_pixels);
    g_frame.stride = kWidth;
    g_frame.data_depth = 8;
  }
  g_frame.timestamp = now_us() - (g_shown != nullptr ? 0 : 7000);
  last_us = now_us();
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
  return (fault("corrupt") && g_taken == 2) || (fault("all_corrupt") && g_taken >= 2)
             ? DC1394_TRUE
             : DC1394_FALSE;
}

}  // extern "C"
