#include "kestrel/io/dc1394_camera.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "dc1394_bus.hpp"
#include "dc1394_picture.hpp"
#include "dc1394_trigger.hpp"

namespace kestrel {
namespace {

using iidc::fail;
using iidc::require;

constexpr std::uint32_t kBuffers = 4;
constexpr auto kPollInterval = std::chrono::milliseconds(1);
constexpr double kWait_s = 0.1;
constexpr double kLongestShot_s =
    1;                            // from a software trigger to its picture, but for the exposure
constexpr double kOldest_s = 10;  // a stamp older than that is wrong

iidc::Bus opened_bus() {
  iidc::Bus bus(dc1394_new());
  if (!bus) fail("the FireWire bus cannot be opened; check /dev/fw* and its permissions");
  return bus;
}

/// Sets a feature by hand to a value in its absolute unit.
void set_feature(dc1394camera_t& camera, dc1394feature_t feature, std::optional<double> value,
                 const char* key) {
  if (!value) return;
  const bool done =
      dc1394_feature_set_mode(&camera, feature, DC1394_FEATURE_MODE_MANUAL) == DC1394_SUCCESS &&
      dc1394_feature_set_absolute_control(&camera, feature, DC1394_ON) == DC1394_SUCCESS &&
      dc1394_feature_set_absolute_value(&camera, feature, float(*value)) == DC1394_SUCCESS;
  if (!done) fail(fmt::format("{}: the camera does not take {}; remove the key", key, *value));
}

/// A ring buffer picture that goes back at the end of its scope.
class Loan {
 public:
  Loan(dc1394camera_t& camera, dc1394video_frame_t& frame) : camera_(camera), frame_(frame) {}
  ~Loan() {
    if (!given_back_) dc1394_capture_enqueue(&camera_, &frame_);
  }
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;
  void give_back() {
    given_back_ = true;
    require(dc1394_capture_enqueue(&camera_, &frame_), "giving a frame back");
  }

 private:
  dc1394camera_t& camera_;
  dc1394video_frame_t& frame_;
  bool given_back_ = false;
};

class Dc1394Camera : public CameraDevice {
 public:
  Dc1394Camera(const std::string& guid, const CaptureSettings& settings)
      : bus_(opened_bus()), trigger_(settings.trigger) {
    camera_.reset(dc1394_camera_new(bus_.get(), iidc::guid_of(*iidc::cameras_on(*bus_), guid)));
    if (!camera_) fail("the camera cannot be opened; check the permissions of /dev/fw*");
    choose(settings);
    set_feature(*camera_, DC1394_FEATURE_SHUTTER, settings.exposure_s, "exposure_s");
    set_feature(*camera_, DC1394_FEATURE_GAIN, settings.gain, "gain");
    iidc::set_trigger(*camera_, trigger_);
    if (trigger_ && trigger_->source == "software") {
      by_software_.emplace(settings.rate_hz.value_or(0),
                           kLongestShot_s + settings.exposure_s.value_or(0));
    }
    require(dc1394_capture_setup(camera_.get(), kBuffers, DC1394_CAPTURE_FLAGS_DEFAULT),
            "reserving the bus");
    const dc1394error_t error = dc1394_video_set_transmission(camera_.get(), DC1394_ON);
    if (error != DC1394_SUCCESS) dc1394_capture_stop(camera_.get());
    require(error, "starting the camera");
  }
  ~Dc1394Camera() override {
    dc1394_video_set_transmission(camera_.get(), DC1394_OFF);
    dc1394_capture_stop(camera_.get());
  }
  Dc1394Camera(const Dc1394Camera&) = delete;
  Dc1394Camera& operator=(const Dc1394Camera&) = delete;

  /// The polling calls only: with the waiting ones a camera that is unplugged is waited for for
  /// ever.
  std::optional<Picture> next() override {
    for (const double until_s = monotonic_clock_s() + kWait_s; monotonic_clock_s() < until_s;) {
      if (by_software_) by_software_->ask(*camera_, monotonic_clock_s());
      dc1394video_frame_t* raw = nullptr;
      require(dc1394_capture_dequeue(camera_.get(), DC1394_CAPTURE_POLICY_POLL, &raw),
              "taking a frame; check the cable");
      if (raw == nullptr) {
        std::this_thread::sleep_for(kPollInterval);
        continue;
      }
      if (by_software_) by_software_->picture_came();
      Loan loan(*camera_, *raw);
      Picture picture = picture_of(*raw);
      loan.give_back();
      return picture;
    }
    return std::nullopt;
  }

  CaptureClock clock() const override { return clock_; }

  std::string silence(double seconds) const override {
    const bool is_from_outside = trigger_ && !by_software_;
    return is_from_outside ? iidc::no_trigger(*trigger_, seconds) : CameraDevice::silence(seconds);
  }

 private:
  void choose(const CaptureSettings& settings) {
    const std::vector<iidc::Mode> modes = iidc::modes_of(*camera_);
    std::vector<CameraMode> plain;
    plain.reserve(modes.size());
    for (const iidc::Mode& mode : modes) plain.push_back(mode.mode);
    ChosenMode chosen;
    try {
      chosen = choose_mode(plain, settings, iidc::formats());
    } catch (const std::runtime_error& error) {
      fail(std::string(error.what()) + " in the formats that are read");
    }
    const auto it = std::find_if(modes.begin(), modes.end(), [&](const iidc::Mode& mode) {
      return mode.mode.format == chosen.mode.format && mode.mode.size == chosen.mode.size &&
             mode.mode.rates_hz == chosen.mode.rates_hz;
    });
    iidc::set_mode(*camera_, *it, chosen.rate_hz);
    if (it->coding == DC1394_COLOR_CODING_RAW8 || it->coding == DC1394_COLOR_CODING_RAW16)
      require(dc1394_format7_get_color_filter(camera_.get(), it->id, &pattern_),
              "asking for the pattern of its colours");
  }

  Picture picture_of(const dc1394video_frame_t& raw) {
    Picture picture;
    picture.captured_s = captured_s(raw);
    if (dc1394_capture_is_frame_corrupt(camera_.get(), const_cast<dc1394video_frame_t*>(&raw)) ==
        DC1394_TRUE) {
      picture.damage = "arrived corrupt";
      return picture;
    }
    picture.gray = iidc::gray_of(raw, pattern_);
    return picture;
  }

  /// libdc1394's stamp is of the wall clock: its age is what counts.
  double captured_s(const dc1394video_frame_t& raw) {
    using Wall = std::chrono::system_clock;
    const double wall_s = std::chrono::duration<double>(Wall::now().time_since_epoch()).count();
    const double age_s = wall_s - 1e-6 * double(raw.timestamp);
    const bool is_true = age_s >= 0 && age_s < kOldest_s;
    clock_ = is_true ? CaptureClock::Driver : CaptureClock::Arrival;
    return monotonic_clock_s() - (is_true ? age_s : 0);
  }

  iidc::Bus bus_;
  iidc::Camera camera_;
  dc1394color_filter_t pattern_ = DC1394_COLOR_FILTER_RGGB;
  CaptureClock clock_ = CaptureClock::Driver;
  std::optional<TriggerSettings> trigger_;
  std::optional<iidc::SoftwareTrigger> by_software_;
};

}  // namespace

std::unique_ptr<CameraDevice> open_dc1394(const std::string& guid,
                                          const CaptureSettings& settings) {
  return std::make_unique<Dc1394Camera>(guid, settings);
}

}  // namespace kestrel
