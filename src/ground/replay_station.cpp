#include "kestrel/ground/replay_station.hpp"

#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "kestrel/ground/stream_frame.hpp"
#include "kestrel/io/image_codec.hpp"

#include "http_parts.hpp"

namespace kestrel {
namespace {

constexpr std::size_t kThreads = 32;

/// A whole number among the query's, of a range; empty otherwise.
std::optional<long> number_in(const httplib::Request& request, const char* name, long most) {
  const std::string text = request.get_param_value(name);
  const bool is_number = !text.empty() && text.size() < 10 &&
                         text.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number) return std::nullopt;
  const long number = std::stol(text);
  return number <= most ? std::optional<long>(number) : std::nullopt;
}

/// Which frames of which run.
struct Wanted {
  std::size_t run = 0;
  std::size_t next = 0;
  std::size_t end = 0;
};

/// Commands go nowhere.
struct Nowhere final : CommandSink {
  void send(const VelocityCommand&, double) noexcept override {}
  long failures() const override { return 0; }
};

/// Of the first run's task, which the page shows the limits of.
Task shown_task(const std::vector<Recording>& recordings) {
  if (recordings.front().run.task) return *recordings.front().run.task;
  CameraParameters any;  // no picture is measured with it
  any.px = any.py = 1;
  return Task{Camera(any)};
}

std::vector<Recording> checked(std::vector<Recording> recordings) {
  if (recordings.empty() || recordings.size() > ReplayStation::kMaxRuns) {
    throw std::invalid_argument("replay: one run, or two to compare");
  }
  for (const Recording& recording : recordings) {
    if (recording.run.log.rows.empty()) {
      throw std::invalid_argument(recording.run.name + ": holds no frame");
    }
  }
  return recordings;
}

}  // namespace

struct ReplayStation::Parts {
  std::vector<Recording> recordings;
  std::mutex mutex;  // of the pictures
  Nowhere nowhere;
  CommandGate gate{nowhere};
  Shared shared;
  HttpServer page;

  Parts(const GroundOptions& options, const AccessToken& token, std::vector<Recording> given)
      : recordings(checked(std::move(given))),
        shared{options,
               token,
               [] { return 0.0; },
               {},
               {shown_task(recordings), gate, "replay"},
               {},
               {},
               {0},
               {0},
               {0},
               {0},
               int(recordings.size())},
        page(guarded(shared, kThreads), shared.refusals.connections) {
    serve_files(page.routes(), shared);
    page.routes().Get("/runs", [this](const auto& request, auto& response) {
      if (lets_in(shared, request, response)) give_runs(response);
    });
    page.routes().Get("/frames", [this](const auto& request, auto& response) {
      if (lets_in(shared, request, response)) give_frames(request, response);
    });
    shared.page_port = page.listen(options.host, options.port);
  }
  ~Parts() { page.stop(); }

  void give_runs(httplib::Response& response) {
    std::string all = "[";
    for (const Recording& recording : recordings) {
      all += (all.size() > 1 ? "," : "") + json(recording.run);
    }
    response.set_content(all + "]", "application/json");
  }

  void give_frames(const httplib::Request& request, httplib::Response& response) {
    const auto run = number_in(request, "run", long(recordings.size()) - 1);
    const auto count = number_in(request, "count", kMaxFrames);
    const long last = run ? long(recordings[std::size_t(*run)].run.log.rows.size()) - 1 : 0;
    const auto from = number_in(request, "from", last);
    if (!run || !from || !count || *count == 0) {
      ++shared.refusals.malformed;
      return say(response, 400, "run, from or count: is no number, or there is no such frame");
    }
    const auto wanted = std::make_shared<Wanted>(Wanted{
        std::size_t(*run), std::size_t(*from), std::size_t(std::min(*from + *count, last + 1))});
    response.set_chunked_content_provider(
        "application/octet-stream", [this, wanted](std::size_t, httplib::DataSink& sink) {
          if (wanted->next == wanted->end) {
            sink.done();
            return true;
          }
          const std::string bytes = frame(wanted->run, wanted->next++);
          return sink.write(bytes.data(), bytes.size());
        });
  }

  std::string frame(std::size_t run, std::size_t row) {
    Recording& recording = recordings[run];
    GroundView view;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      const std::int64_t number = recording.run.log.rows[row].frame;
      view = replay_view(recording.run, row, recording.pictures.picture(std::int64_t(row), number));
    }
    const std::string words = "{\"view\":" + json(view) + ",\"desk\":" + desk_json(shared) +
                              ",\"encode_ms\":0,\"row\":" + std::to_string(row) + "}";
    return stream_frame(words, encode_jpeg(view.gray, shared.options.jpeg_quality));
  }
};

ReplayStation::ReplayStation(const GroundOptions& options, const AccessToken& token,
                             std::vector<Recording> recordings) {
  options.check();
  GroundOptions of_replay = options;
  of_replay.view_only = "a recorded run: nothing flies here";
  parts_ = std::make_unique<Parts>(of_replay, token, std::move(recordings));
}

ReplayStation::~ReplayStation() = default;

std::uint16_t ReplayStation::port() const { return parts_->shared.page_port; }
std::string ReplayStation::address() const { return address_of(parts_->shared); }
GroundRefusals ReplayStation::refusals() const { return counted(parts_->shared.refusals); }

}  // namespace kestrel
