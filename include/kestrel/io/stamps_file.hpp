#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>

namespace kestrel {

/// When each frame of a sequence was captured, s, by its index: a CSV file with the header
/// "frame,stamp_s", frames and stamps increasing. Throws FileError with the line for every mistake.
std::map<std::int64_t, double> load_stamps(const std::filesystem::path& file);

/// When a frame was captured, s; empty when nobody knows.
using StampOf = std::function<std::optional<double>(std::int64_t index)>;

/// index / rate_hz.
StampOf stamps_at(double rate_hz);

/// Those of a file.
StampOf stamps_in(const std::filesystem::path& file);

}  // namespace kestrel
