#pragma once

#include <memory>
#include <string>

#include "arguments.hpp"

namespace CLI {
class App;
}

namespace kestrel::app {

/// The rectangle in "x,y,w,h". Throws CLI::ValidationError for anything else.
PixelBox parse_roi(const std::string& text);

/// What a live camera is asked for: --format, --size, --rate, --exposure, --gain, --trigger.
void add_capture(CLI::App& verb, const std::shared_ptr<CaptureSettings>& capture);

/// The verbs `cameras` and `record` with their options.
void add_cameras(CLI::App& app, const std::shared_ptr<CamerasArguments>& arguments);
void add_record(CLI::App& app, const std::shared_ptr<RecordArguments>& arguments);

}  // namespace kestrel::app
