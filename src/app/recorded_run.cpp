#include "recorded_run.hpp"

#include <stdexcept>
#include <utility>

#include "kestrel/eval/spread.hpp"
#include "kestrel/io/text_file.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

/// The root of the task that the run was made with.
Section task_of(const fs::path& folder, const fs::path& given) {
  if (!given.empty()) return Section::load(given);
  const fs::path own = folder / "configuration.yaml";
  if (!fs::exists(own) || !fs::exists(folder / kOriginFile)) {
    throw std::runtime_error(
        folder.string() + ": holds no task of a servo or simulate run; name it with --task FILE");
  }
  std::string origin = read_text(folder / kOriginFile);
  while (!origin.empty() && (origin.back() == '\n' || origin.back() == '\r')) origin.pop_back();
  return Section::parse(origin, read_text(own));
}

}  // namespace

bool is_run_folder(const fs::path& path) {
  return fs::is_directory(path) && fs::exists(path / "run.csv");
}

RecordedRun load_run(const fs::path& folder, const fs::path& task) {
  if (!is_run_folder(folder)) {
    throw std::runtime_error(folder.string() +
                             ": is no run folder; one has the file run.csv in it");
  }
  return {read_experiment(task_of(folder, task)), read_log(folder / "run.csv")};
}

double rate_hz(const LogFile& log) {
  std::vector<double> periods_s;
  for (std::size_t i = 1; i < log.rows.size(); ++i) {
    periods_s.push_back(log.rows[i].stamp_s - log.rows[i - 1].stamp_s);
  }
  const auto spread = spread_of(std::move(periods_s));
  return spread && spread->median > 0 ? 1 / spread->median : 30;
}

}  // namespace kestrel::app
