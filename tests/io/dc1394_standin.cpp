// A stand-in for libdc1394, preloaded in front of it: one camera that sends frames, and the faults
// that the environment variable KESTREL_DC1394_FAULT names. It proves how Kestrel uses the library,
// not the bus.
#include <cstdlib>
#include <cstring>
#include <string>

#include <dc1394/dc1394.h>

namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 480;
unsigned char g_pixels[kWidth * kHeight];  // NOLINT
dc1394video_frame_t g_frame;               // NOLINT
dc1394camera_t g_camera;                   // NOLINT
int g_bus;                                 // NOLINT
int g_taken;                               // NOLINT
int g_out;                                 // NOLINT

bool fault(const char* name) {
  const char* set = std::getenv("KESTREL_DC1394_FAULT");
  return set != nullptr && std::strcmp(set, name) == 0;
}

}  // namespace

extern "C" {

/// Frames that were taken and not given back; also says that the stand-in is there.
int kestrel_dc1394_frames_out() { return g_out; }

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
  g_camera.guid = guid;
  return &g_camera;
}
void dc1394_camera_free(dc1394camera_t*) {}
dc1394error_t dc1394_video_set_iso_speed(dc1394camera_t*, dc1394speed_t) { return DC1394_SUCCESS; }
dc1394error_t dc1394_video_get_supported_modes(dc1394camera_t*, dc1394video_modes_t* modes) {
  modes->num = 2;
  modes->modes[0] = DC1394_VIDEO_MODE_640x480_YUV411;
  modes->modes[1] =
      fault("odd_modes") ? DC1394_VIDEO_MODE_160x120_YUV444 : DC1394_VIDEO_MODE_640x480_MONO8;
  if (fault("odd_modes")) modes->modes[0] = DC1394_VIDEO_MODE_FORMAT7_0;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_set_mode(dc1394camera_t*, dc1394video_mode_t mode) {
  g_frame.video_mode = mode;
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
  return rate == DC1394_FRAMERATE_30 ? DC1394_SUCCESS : DC1394_INVALID_FRAMERATE;
}
dc1394error_t dc1394_capture_setup(dc1394camera_t*, uint32_t, uint32_t) {
  return fault("no_bandwidth") ? DC1394_NO_BANDWIDTH : DC1394_SUCCESS;
}
dc1394error_t dc1394_capture_stop(dc1394camera_t*) { return DC1394_SUCCESS; }
dc1394error_t dc1394_video_set_transmission(dc1394camera_t*, dc1394switch_t) {
  return DC1394_SUCCESS;
}
/// Frame k has grey value k. Every third call finds nothing yet; frames 4 and 5 wait together.
dc1394error_t dc1394_capture_dequeue(dc1394camera_t*, dc1394capture_policy_t policy,
                                     dc1394video_frame_t** frame) {
  static int calls = 0;
  *frame = nullptr;
  if (policy != DC1394_CAPTURE_POLICY_POLL) return DC1394_INVALID_CAPTURE_POLICY;
  if (fault("dequeue_error") && g_taken == 3) return DC1394_IOCTL_FAILURE;
  if (fault("unplugged") && g_taken >= 3) return DC1394_SUCCESS;
  if (++calls % 3 == 0) return DC1394_SUCCESS;
  std::memset(g_pixels, g_taken, sizeof g_pixels);
  g_frame.image = g_pixels;
  g_frame.size[0] = kWidth;
  g_frame.size[1] = kHeight;
  g_frame.stride = kWidth;
  g_frame.color_coding = DC1394_COLOR_CODING_MONO8;
  g_frame.data_depth = 8;
  g_frame.frames_behind = g_taken == 4 ? 1 : 0;
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
