#include "kestrel/io/timing_log.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace kestrel {

TimingLog::TimingLog(const std::filesystem::path& path, const std::vector<std::string>& stages)
    : file_(path), stages_(stages.size()) {
  std::string header = "frame";
  for (const std::string& stage : stages) header += "," + stage + "_ms";
  file_.write(header);
}

void TimingLog::write(std::int64_t frame, const std::vector<double>& times_ms) {
  if (times_ms.size() != stages_)
    throw std::invalid_argument(
        fmt::format("timing log: {} times for {} stages", times_ms.size(), stages_));
  std::string line = std::to_string(frame);
  for (const double time : times_ms)
    line += std::isfinite(time) ? fmt::format(",{:.3f}", time) : ",";
  file_.write(line);
}

}  // namespace kestrel
