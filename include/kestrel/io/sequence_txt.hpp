#pragma once

#include <filesystem>

#include "kestrel/io/sequence_file.hpp"

namespace kestrel {

/// Reads a sequence described by a file `sequence.txt` of lines `key: value` with its labels in
/// `gt.csv` beside it (truth; absent: none). Keys: `images` (a video, a pattern, or `FOLDER/: NAME
/// NAME ... in this order`; a trailing `(Debian PACKAGE)` or other words in brackets are notes),
/// `template_rect` (`x0 y0 x1 y1`: centres of the rectangle's first and last pixel, px; absent or
/// empty: the whole pixels inside the first row of the labels), `first_number`, `first_frame`,
/// `last_frame`, `object`, `source`, `licence`; other keys are notes. A relative path is relative
/// to the file. Throws FileError with the line for every mistake.
SequenceDescription load_sequence_txt(const std::filesystem::path& file);

}  // namespace kestrel
