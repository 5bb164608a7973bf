#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kestrel/io/text_file.hpp"

namespace kestrel {

/// A piece of a YAML file as it was written: nothing is converted yet.
struct YamlNode {
  enum class Kind { Empty, Scalar, List, Map };
  struct Entry;

  Kind kind = Kind::Empty;
  int line = 0;                // counts from 1
  std::string scalar;          // of a Scalar
  bool is_plain = false;       // a Scalar without quotes
  std::vector<YamlNode> list;  // of a List
  std::vector<Entry> entries;  // of a Map, in the order of the file

  /// The entry of a Map with this key, or null.
  const Entry* find(const std::string& key) const;
};

/// One line `key: value`.
struct YamlNode::Entry {
  std::string key;
  int line = 0;  // of the key
  YamlNode value;
};

/// The map of keys in a YAML text; `file` names it in errors. Throws FileError with the line for
/// what is no YAML, an empty text, anything after the first document, a root that is no map, a key
/// that is given twice or is no single word, and more than 100000 values (aliases that multiply).
YamlNode parse_yaml(const std::filesystem::path& file, const std::string& text);

/// "a list", "a section of keys", "a text or number" or "empty".
const char* describe(YamlNode::Kind kind);

}  // namespace kestrel
