#include "evaluate_inputs.hpp"

#include <algorithm>

#include "kestrel/io/image_files.hpp"
#include "kestrel/io/sequence_file.hpp"
#include "kestrel/io/sequence_txt.hpp"
#include "kestrel/io/truth_file.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kText = "sequence.txt";

bool is_yaml(const fs::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

/// The files a sequence's frames are read from.
std::vector<fs::path> files_of(const SequenceOptions& options) {
  if (!options.files.empty()) return options.files;
  if (fs::is_regular_file(options.input)) return {options.input};
  const bool is_pattern = options.input.find('%') != std::string::npos;
  if (!is_pattern && !fs::is_directory(options.input)) return {};
  std::vector<fs::path> files;
  for (const auto& entry :
       is_pattern ? files_of_pattern(options.input) : files_of_folder(options.input)) {
    files.push_back(entry.second);
  }
  return files;
}

/// Files with sizes and dates: what is changed without a change of these counts as unchanged.
std::string fingerprint(const SequenceDescription& description) {
  const SequenceOptions& o = description.sequence;
  std::string text = o.input + ' ' + std::to_string(o.first_number.value_or(-1)) + ' ' +
                     std::to_string(o.first_frame) + ' ' +
                     std::to_string(o.last_frame.value_or(-1));
  for (const fs::path& file : files_of(o)) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error) continue;
    const auto date = fs::last_write_time(file, error).time_since_epoch().count();
    text += '\n' + file.string() + ' ' + std::to_string(size) + ' ' + std::to_string(date);
  }
  return text;
}

EvaluateInput input_of(const std::string& name, const SequenceDescription& description) {
  EvaluateInput input;
  input.sequence.name = name;
  input.sequence.open = [options = description.sequence] { return open_sequence(options); };
  input.sequence.template_px = description.template_px;
  if (description.truth) input.sequence.truth = load_truth(*description.truth);
  input.files = fingerprint(description);
  return input;
}

EvaluateInput one_input(const fs::path& file) {
  if (is_yaml(file)) return input_of(file.stem().string(), load_sequence(file));
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  return input_of(folder.filename().string(), load_sequence_txt(file));
}

/// The descriptions in a folder that is none itself.
std::vector<fs::path> descriptions_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / kText)) files.push_back(entry.path() / kText);
    const bool is_file = entry.is_regular_file() && is_yaml(entry.path());
    if (is_file && Section::load(entry.path()).has("images")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<EvaluateInput> evaluate_inputs(const fs::path& argument) {
  if (!fs::is_directory(argument)) return {one_input(argument)};
  if (fs::exists(argument / kText)) return {one_input(argument / kText)};
  std::vector<EvaluateInput> inputs;
  for (const fs::path& file : descriptions_in(argument)) inputs.push_back(one_input(file));
  if (inputs.empty()) {
    throw FileError(argument, 0, "",
                    "holds no sequence: no NAME.yaml with images, no folder with a sequence.txt; "
                    "name another");
  }
  return inputs;
}

}  // namespace kestrel::app
