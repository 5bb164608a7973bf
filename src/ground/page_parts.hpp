#pragma once

#include <string_view>

namespace kestrel {

/// The page (src/ground/page/ground.html); {{COMMAND_PORT}} stands for the port of the commands
/// and {{RECORDED_RUNS}} for how many recorded runs it shows instead of a flight.
std::string_view ground_html();

/// Its style sheet (ground.css, controls.css).
std::string_view ground_css();

/// Its script (stream.js, picture.js, plots.js, commands.js, sticks.js, settings.js,
/// views.js, replay.js, page.js, in one).
std::string_view ground_script();

}  // namespace kestrel
