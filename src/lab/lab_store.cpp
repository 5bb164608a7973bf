#include "kestrel/lab/lab_store.hpp"

#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>

#include "kestrel/eval/bench_store.hpp"
#include "kestrel/io/text_file.hpp"
#include "kestrel/lab/trace_csv.hpp"

#include "stored_line.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFinished = "finished.jsonl";
constexpr const char* kPart = "finished.part.jsonl";
constexpr const char* kTiming = "timing.csv";

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw std::runtime_error(path.string() + ": cannot write: " + error.message() +
                           "; choose a folder that can be written");
}

/// The file appears whole or not at all.
void replace(const fs::path& file, const std::string& text) {
  fs::path beside = file;
  beside += ".new";
  write_text(beside, text);
  std::error_code error;
  fs::rename(beside, file, error);
  if (error) fail(file, error);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, error);
}

/// law_us of timing.csv by id; ids have no commas.
std::map<std::string, double> read_times(const fs::path& file) {
  std::map<std::string, double> times;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t comma = line.rfind(',');
    if (comma == std::string::npos) continue;
    if (const auto value = csv_number(line.substr(comma + 1)))
      times[line.substr(0, comma)] = *value;
  }
  return times;
}

/// The trace as it was left; empty when it is not there as it should be.
std::optional<RunTrace> read_trace(const fs::path& file, std::size_t rows) {
  if (rows == 0) return RunTrace{};
  try {
    RunTrace trace = trace_of_csv(read_text(file));
    if (trace.rows.size() == rows) return trace;
  } catch (const std::exception&) {  // whatever is wrong with it, the run is made again
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

LabRun storable(LabRun run) {
  for (auto& [name, value] : run.metrics) {
    if (value && !std::isfinite(*value)) value.reset();
  }
  return run;
}

fs::path path_of_id(const std::string& id) {
  fs::path path;
  for (std::size_t begin = 0; begin <= id.size();) {
    const std::size_t end = std::min(id.find('/', begin), id.size());
    path /= file_name(id.substr(begin, end - begin));
    begin = end + 1;
  }
  return path;
}

LabStore::LabStore(fs::path folder) : folder_(std::move(folder)) {}

fs::path LabStore::trace_file(const std::string& id) const {
  fs::path file = folder_ / "runs" / path_of_id(id);
  file += ".csv";
  return file;
}

std::map<std::string, StoredRun> LabStore::load() const {
  std::map<std::string, StoredRun> runs;
  const auto times = read_times(folder_ / kTiming);
  for (const char* file : {kFinished, kPart}) {
    std::ifstream in(folder_ / file);
    for (std::string text; std::getline(in, text);) {
      std::optional<StoredLine> line = read_stored_line(text);
      if (!line) continue;
      LabRun& run = line->stored.run;
      const auto time = times.find(run.id);
      if (file == kFinished && time != times.end()) run.law_us = time->second;
      auto trace = read_trace(trace_file(run.id), line->trace_rows);
      if (!trace) continue;
      run.trace = std::move(*trace);
      runs[run.id] = std::move(line->stored);
    }
  }
  return runs;
}

void LabStore::keep(const StoredRun& finished) {
  if (!finished.run.trace.rows.empty()) {
    const fs::path file = trace_file(finished.run.id);
    make_folder(file.parent_path());
    write_text(file, trace_csv(finished.run.trace));
  }
  const std::string line = stored_line(finished, LineTimes::Kept);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!part_) {
    make_folder(folder_);
    part_ = std::make_unique<LineFile>(folder_ / kPart);
  }
  part_->write(line);
}

void LabStore::remove_traces_but(const std::vector<const StoredRun*>& finished) const {
  std::set<fs::path> wanted;
  for (const StoredRun* stored : finished) {
    if (!stored->run.trace.rows.empty()) wanted.insert(trace_file(stored->run.id));
  }
  std::error_code error;
  std::vector<fs::path> strange;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "runs", error)) {
    const bool is_trace = entry.is_regular_file() && entry.path().extension() == ".csv";
    if (is_trace && wanted.count(entry.path()) == 0) strange.push_back(entry.path());
  }
  for (const fs::path& file : strange) {
    fs::remove(file, error);
    for (fs::path up = file.parent_path(); up != folder_ && fs::remove(up, error);) {
      up = up.parent_path();  // folders left empty
    }
  }
}

void LabStore::seal(const std::vector<const StoredRun*>& finished) {
  std::string lines;
  std::string times = "id,law_us\n";
  for (const StoredRun* stored : finished) {
    lines += stored_line(*stored, LineTimes::Left) + '\n';
    times += stored->run.id + ',' + number(stored->run.law_us) + '\n';
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  make_folder(folder_);
  replace(folder_ / kTiming, times);
  replace(folder_ / kFinished, lines);
  part_.reset();
  std::error_code error;
  fs::remove(folder_ / kPart, error);
  remove_traces_but(finished);
}

}  // namespace kestrel
