#pragma once

#include <string_view>

namespace kestrel {

/// The style sheet of the page (src/lab/page/page.css).
std::string_view page_style();

/// The controls and the empty places of the plots that the script fills (explore.html).
std::string_view page_explorer();

/// The script (plot.js, space.js, explorer.js, choice.js); it reads page_data() from #data.
std::string_view page_script();

}  // namespace kestrel
