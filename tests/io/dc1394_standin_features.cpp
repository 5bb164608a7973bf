// The modes, features and trigger of the stand-in's camera, and what tests ask of them.
#include "io/dc1394_standin.hpp"

using namespace kestrel::test::dc1394;  // NOLINT: the library's own names stand at the top

extern "C" {

/// What was set.
float kestrel_dc1394_shutter_s() { return g_shutter_s; }
float kestrel_dc1394_gain() { return g_gain; }
int kestrel_dc1394_rate() { return g_rate; }
int kestrel_dc1394_speed() { return g_speed; }
/// Power, source, mode, polarity of the trigger as the library numbers them.
int kestrel_dc1394_trigger_power() { return g_waits; }
int kestrel_dc1394_trigger_source() { return g_source; }
int kestrel_dc1394_trigger_mode() { return g_mode; }
int kestrel_dc1394_trigger_polarity() { return g_polarity; }

dc1394error_t dc1394_video_set_operation_mode(dc1394camera_t*, dc1394operation_mode_t mode) {
  return mode == DC1394_OPERATION_MODE_1394B ? DC1394_SUCCESS : DC1394_FAILURE;
}
dc1394error_t dc1394_video_set_iso_speed(dc1394camera_t*, dc1394speed_t speed) {
  if (speed == DC1394_ISO_SPEED_800 && fault("no_800")) return DC1394_FAILURE;
  g_speed = speed;
  return DC1394_SUCCESS;
}
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

}  // extern "C"
