#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kestrel/geometry/pixel.hpp"
#include "kestrel/io/live_options.hpp"
#include "kestrel/link/autopilot_profile.hpp"
#include "kestrel/link/axis_response.hpp"
#include "kestrel/vision/track_options.hpp"

#include "calibrate.hpp"
#include "compare.hpp"
#include "evaluate.hpp"
#include "explain.hpp"
#include "switch.hpp"

namespace kestrel::app {

/// Options of every verb that leaves a run folder.
struct RunArguments {
  std::filesystem::path output;  // empty: runs/<name>, a number added when it exists
  bool video = true;
  bool display = false;
};

/// The ground station of a run.
struct GroundArguments {
  std::optional<std::uint16_t> port;  // of the page; empty: no ground station
  std::string host = "127.0.0.1";
  std::filesystem::path token;        // empty: a new one is printed
  std::filesystem::path certificate;  // PEM, with its key; both empty: none
  std::filesystem::path key;
  bool self_signed = false;
  bool plain = false;  // HTTP beyond this machine
  std::string link;    // of the operator's own to a switch, udp://HOST:PORT; empty: none
  std::filesystem::path link_key;  // of that link; empty: none
  bool keys = false;               // those of the terminal, where there is one, stop the flight
};

struct TrackArguments {
  std::string input;  // sequence description, printf pattern, folder, video, camera:N ...
  std::optional<PixelBox> roi;
  int first_frame = 0;
  std::optional<int> last_frame;
  std::optional<double> rate_hz;
  std::filesystem::path truth;
  std::filesystem::path camera;
  std::string camera_name = "Camera";
  std::vector<double> size_m;  // width, height of the target; empty: no pose
  TrackMethod method = TrackMethod::Hybrid;
  GroundArguments ground;
  RunArguments run;
};

/// When the frames of a recording go down the chain.
enum class Pace { AsFastAsPossible, RealTime };

struct ServoArguments {
  std::filesystem::path task;
  std::string source;  // empty: the task's
  std::string sink;
  Pace pace = Pace::AsFastAsPossible;
  GroundArguments ground;
  RunArguments run;
};

/// Whole numbers from first to last, both included.
struct SeedRange {
  std::int64_t first = 1;
  std::int64_t last = 1;
};

/// How `simulate` meets other programs, in real time.
struct RealTimeArguments {
  std::uint16_t vehicle_port = 14550;      // UDP on 127.0.0.1; 0: any free one
  std::string frames = "127.0.0.1:14570";  // where frames are served
  std::string vehicle;                     // mavlink:udp:HOST:PORT; empty: the built-in one
  std::vector<double> origin_ned_m;        // of the vehicle's local frame; empty: below the start
  Autopilot autopilot = Autopilot::ArduPilot;
  bool starts_in_air = true;  // and armed; else on the ground and not
};

struct SimulateArguments {
  std::filesystem::path task;
  std::optional<double> duration_s;
  std::optional<std::int64_t> seed;
  std::optional<SeedRange> seeds;
  std::string sink;
  std::optional<RealTimeArguments> real_time;
  GroundArguments ground;
  std::filesystem::path record;  // folder for the frames as a sequence with truth; empty: none
  RunArguments run;
};

/// The options of the verb but for those of its run folder.
void add_simulate_options(CLI::App& verb, const std::shared_ptr<SimulateArguments>& arguments);

struct ReceiveArguments {
  std::string address = "udp://127.0.0.1:14550";
  std::filesystem::path log;
  std::optional<double> duration_s;
  std::optional<long> count;
  bool quiet = false;
  std::optional<Autopilot> autopilot;  // the one to stand in for; empty: none
  bool starts_in_air = true;           // and armed; else on the ground and not
};

/// Moves a real vehicle, one axis after the other, and says what it did.
struct JogArguments {
  std::string to;
  std::vector<MotionAxis> axes = {MotionAxis::Forward, MotionAxis::Right, MotionAxis::Down,
                                  MotionAxis::Yaw};
  double speed_m_s = 0.3;
  double yaw_rate_deg_s = 10;
  double seconds = 2;
  double wait_s = 20;  // for the autopilot, and then for control
  double takeoff_m = 0;
  bool allow_arming = false;
  bool yes = false;
  bool json = false;
};

/// Lists what is connected.
struct CamerasArguments {
  bool json = false;
};

/// Keeps what a source gives.
struct RecordArguments {
  std::string source;            // as INPUT of track
  std::filesystem::path output;  // a new folder, or a file .mp4
  CaptureSettings capture;
  std::optional<PixelBox> roi;  // of the description
  std::optional<double> duration_s;
  std::optional<std::int64_t> frames;
  std::size_t queue = 100;  // pictures that wait for the disk
  double give_up_s = 60;
  bool allow_drops = false;
};

/// Shows recorded runs in the ground station's page.
struct ReplayArguments {
  std::vector<std::filesystem::path> runs;  // one, or two to compare
  GroundArguments ground;
};

struct CheckArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path output;  // folder for the drawings of mounts; empty: none
};

struct DemoArguments {
  std::filesystem::path tasks = "tasks";
  std::filesystem::path output;
};

using Arguments = std::variant<TrackArguments, ServoArguments, SimulateArguments, ReceiveArguments,
                               CheckArguments, DemoArguments, EvaluateArguments, CompareArguments,
                               MergeArguments, LawsArguments, ExplainArguments, SwitchArguments,
                               KeyArguments, JogArguments, CalibrateArguments, HandEyeArguments,
                               CamerasArguments, RecordArguments, ReplayArguments>;

/// What the command line asks for: a verb's arguments, or an exit code after help, version or a
/// usage error have been printed (0 or 2).
std::variant<Arguments, int> parse_command_line(int argc, char** argv);

}  // namespace kestrel::app
