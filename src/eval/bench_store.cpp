#include "kestrel/eval/bench_store.hpp"

#include <cctype>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/text_file.hpp"

#include "bench_rows.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Part of the inputs: another layout of the files is another result.
constexpr const char* kFormat = "kestrel bench 1";

std::string inputs_digest(const std::string& inputs) { return digest(kFormat + inputs); }

std::string description(const BenchRun& run, const std::string& inputs) {
  Json json;
  json["sequence"] = run.sequence;
  json["method"] = run.method;
  json["inputs"] = inputs_digest(inputs);
  json["end"] = name(run.end);
  json["reason"] = run.reason;
  json["template_px"] = {run.template_px.u, run.template_px.v, run.template_px.width,
                         run.template_px.height};
  json["frames"] = run.frames.size();
  json["skipped"] = run.skipped;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

BenchEnd end_of(const std::string& word) {
  for (const BenchEnd end : {BenchEnd::Done, BenchEnd::Refused, BenchEnd::Failed}) {
    if (word == name(end)) return end;
  }
  throw std::runtime_error("unknown end " + word);
}

BenchRun described(const Json& json) {
  BenchRun run;
  run.sequence = json.at("sequence");
  run.method = json.at("method");
  run.end = end_of(json.at("end"));
  run.reason = json.at("reason");
  const Json& box = json.at("template_px");
  run.template_px = {box.at(0), box.at(1), box.at(2), box.at(3)};
  run.skipped = json.at("skipped").get<std::vector<std::string>>();
  return run;
}

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw std::runtime_error(path.string() + ": cannot write: " + error.message() +
                           "; choose a folder that can be written");
}

void write_all(const fs::path& folder, const BenchRun& run, const TrackTruth& truth,
               const std::string& inputs) {
  write_text(folder / "frames.csv", frames_csv(run, truth));
  write_text(folder / "times.csv", times_csv(run));
  write_text(folder / "run.json", description(run, inputs));
}

}  // namespace

std::string digest(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return fmt::format("{:016x}", hash);
}

std::string file_name(const std::string& name) {
  constexpr std::size_t kLongest = 120;
  std::string safe = name.substr(0, kLongest);
  for (char& c : safe) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                          std::string_view("._-=").find(c) != std::string_view::npos;
    if (c == ' ') {
      c = ',';
    } else if (!is_plain) {
      c = '_';
    }
  }
  if (safe.empty() || safe[0] == '.') safe.insert(0, "_");
  std::string back = safe;
  for (char& c : back) c = c == ',' ? ' ' : c;
  return back == name ? safe : safe + "-" + digest(name);
}

fs::path BenchStore::folder_of(const std::string& sequence, const std::string& method) const {
  return folder_ / file_name(sequence) / file_name(method);
}

void BenchStore::keep(const BenchRun& run, const TrackTruth& truth,
                      const std::string& inputs) const {
  const fs::path place = folder_of(run.sequence, run.method);
  fs::path beside = place;
  beside += ".part";
  std::error_code error;
  fs::remove_all(beside, error);
  if (!error) fs::create_directories(beside, error);
  if (error) fail(beside, error);
  write_all(beside, run, truth, inputs);
  fs::remove_all(place, error);
  if (!error) fs::rename(beside, place, error);
  if (error) fail(place, error);
}

std::optional<BenchRun> BenchStore::find(const std::string& sequence, const std::string& method,
                                         const std::string& inputs) const {
  const fs::path place = folder_of(sequence, method);
  try {
    if (!fs::exists(place / "run.json")) return std::nullopt;
    const Json json = Json::parse(read_text(place / "run.json"));
    const bool is_same = json.at("sequence") == sequence && json.at("method") == method &&
                         json.at("inputs") == inputs_digest(inputs);
    if (!is_same) return std::nullopt;
    BenchRun run = described(json);
    read_rows(run, read_text(place / "frames.csv"), read_text(place / "times.csv"));
    if (run.frames.size() != json.at("frames")) return std::nullopt;
    return run;
  } catch (const std::exception&) {  // whatever is wrong with it, the run is made again
    return std::nullopt;
  }
}

}  // namespace kestrel
