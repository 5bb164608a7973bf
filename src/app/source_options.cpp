#include "source_options.hpp"

#include <sstream>

#include <CLI/CLI.hpp>

namespace kestrel::app {

PixelBox parse_roi(const std::string& text) {
  std::istringstream in(text);
  double value[4];
  char comma = ',';
  for (int i = 0; i < 4; ++i) {
    if (i > 0 && (!(in >> comma) || comma != ',')) break;
    if (!(in >> value[i])) throw CLI::ValidationError("--roi", "'" + text + "' is not x,y,w,h");
  }
  if (!in || !(in >> std::ws).eof() || !(value[2] > 0 && value[3] > 0)) {
    throw CLI::ValidationError(
        "--roi", "'" + text + "' is not x,y,w,h: four numbers in px, width and height positive");
  }
  return {value[0], value[1], value[2], value[3]};
}

void add_capture(CLI::App& verb, const std::shared_ptr<CaptureSettings>& capture) {
  verb.add_option("--format", capture->format,
                  "Format of the camera, as 'kestrel cameras' names it (default: the best)");
  verb.add_option_function<std::vector<int>>(
          "--size", [capture](const std::vector<int>& s) { capture->size = cv::Size(s[0], s[1]); },
          "Width and height, px (default: 640 480 or what is nearest)")
      ->expected(2);
  verb.add_option("--rate", capture->rate_hz, "Pictures per second, at least (default: most)");
  verb.add_option("--exposure", capture->exposure_s, "Shutter time, s (default: automatic)");
  verb.add_option("--gain", capture->gain, "Gain, the camera's own unit (default: automatic)");
  verb.add_option_function<std::string>(
      "--trigger",
      [capture](const std::string& source) {
        if (!capture->trigger) capture->trigger.emplace();
        capture->trigger->source = source;
      },
      "What starts each picture of a FireWire camera: its input 0 to 3, or software (default: "
      "none)");
}

void add_cameras(CLI::App& app, const std::shared_ptr<CamerasArguments>& a) {
  auto* verb =
      app.add_subcommand("cameras", "List the V4L2 and FireWire cameras and what each can send");
  verb->add_flag("--json", a->json, "Print JSON");
}

void add_record(CLI::App& app, const std::shared_ptr<RecordArguments>& a) {
  auto* verb = app.add_subcommand(
      "record", "Keep every picture of a source, with its time: a sequence folder or a video");
  verb->add_option("SOURCE", a->source,
                   "camera:N, dc1394:GUID, rtsp://..., rtp:..., udp://..., http://..., or what "
                   "track takes")
      ->required();
  verb->add_option("--output", a->output,
                   "A new folder (PNG pictures, stamps.csv, sequence.yaml) or a file .mp4")
      ->required();
  verb->add_option("--duration", a->duration_s, "Stop after this long, s (default: on Ctrl-C)")
      ->check(CLI::PositiveNumber);
  verb->add_option("--frames", a->frames, "Stop after this many pictures (default: on Ctrl-C)")
      ->check(CLI::PositiveNumber);
  add_capture(*verb, {a, &a->capture});
  verb->add_option_function<std::string>(
      "--roi", [a](const std::string& text) { a->roi = parse_roi(text); },
      "Template rectangle x,y,w,h of the description, px (default: the middle)");
  verb->add_option("--queue", a->queue, "Pictures that may wait for the disk (default 100)")
      ->check(CLI::Range(1, 10000));
  verb->add_option("--give-up", a->give_up_s,
                   "End after this long without a picture, s (default 60)")
      ->check(CLI::PositiveNumber);
  verb->add_flag("--allow-drops", a->allow_drops,
                 "Missing pictures are no failure (default: exit 1)");
}

}  // namespace kestrel::app
