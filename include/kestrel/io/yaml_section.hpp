#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kestrel/io/yaml_tree.hpp"

namespace kestrel {

struct SectionItem;

/// A map of a YAML file that remembers which keys were asked for. Every mistake throws FileError
/// with the line: missing key, wrong type, duplicate key, and in done() any key nobody read.
class Section {
 public:
  /// The file's root. Throws FileError for what read_text refuses, for what is no YAML, for an
  /// empty file, several documents, or a root that is no map of keys.
  static Section load(const std::filesystem::path& file);
  /// The root of a text that is in no file; `name` stands for the file in errors.
  static Section parse(const std::filesystem::path& name, const std::string& text);

  /// True when the key is there; makes it known, not read.
  bool has(const std::string& key) const;

  /// A finite decimal number, unquoted.
  double number(const std::string& key) const;
  double number(const std::string& key, double otherwise) const {
    return has(key) ? number(key) : otherwise;
  }
  /// A whole number, unquoted.
  std::int64_t integer(const std::string& key) const;
  std::int64_t integer(const std::string& key, std::int64_t otherwise) const {
    return has(key) ? integer(key) : otherwise;
  }
  /// The same where an int is wanted.
  int whole(const std::string& key, int otherwise) const;
  /// A text that is not empty.
  std::string text(const std::string& key) const;
  std::string text(const std::string& key, const std::string& otherwise) const {
    return has(key) ? text(key) : otherwise;
  }
  /// true or false, nothing else (`yes` is refused).
  bool flag(const std::string& key, bool otherwise) const;
  /// A list of numbers; lists inside it (the rows of a matrix) are read in order.
  std::vector<double> numbers(const std::string& key) const;
  /// A list of exactly this many numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  /// A list of words and of maps; a single word counts as a list of one.
  std::vector<SectionItem> items(const std::string& key) const;
  /// A list of words; a single one counts as a list of one.
  std::vector<std::string> words(const std::string& key) const;
  /// The keys of this section as they stand in the file; makes none of them known.
  std::vector<std::string> keys() const;
  /// A path, relative to the file's folder.
  std::filesystem::path path(const std::string& key) const;

  /// A map below this one.
  Section child(const std::string& key) const;
  std::optional<Section> child_if(const std::string& key) const {
    return has(key) ? std::optional(child(key)) : std::nullopt;
  }

  /// One of several words: choice<E>("interaction", {{"mean", E::Mean}, ...}).
  template <class E>
  E choice(const std::string& key, const std::vector<std::pair<std::string, E>>& words) const {
    std::vector<std::string> names;
    names.reserve(words.size());
    for (const auto& [word, value] : words) names.push_back(word);
    return words[one_of(key, names)].second;
  }
  template <class E>
  E choice(const std::string& key, const std::vector<std::pair<std::string, E>>& words,
           E otherwise) const {
    return has(key) ? choice(key, words) : otherwise;
  }

  /// Throws FileError about this key, or about the section for an empty key.
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

  /// Throws FileError for the first key that nobody read, in this section or in any other of the
  /// file that was opened, and names the known key nearest to it.
  void done() const;

  /// The file it was loaded from.
  const std::filesystem::path& file() const;

 private:
  struct Document;  // shared by the sections of one file: what was read is known to all
  struct Value;
  Section(std::shared_ptr<Document> document, std::size_t record);
  Value value(const std::string& key) const;
  Section opened(const std::string& name, const YamlNode& node, int line) const;
  std::size_t one_of(const std::string& key, const std::vector<std::string>& words) const;

  std::shared_ptr<Document> document_;
  std::size_t record_;
};

/// An item of a list: a word, or a map of keys.
struct SectionItem {
  std::string word;  // empty when there are keys
  std::optional<Section> keys;
};

}  // namespace kestrel
