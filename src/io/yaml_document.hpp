#pragma once

#include <set>
#include <string>
#include <vector>

#include "kestrel/io/yaml_section.hpp"

namespace kestrel {

/// A file, and what was asked of its maps.
struct Section::Document {
  /// One map of the file that was opened, and what was asked of it.
  struct Record {
    std::string name;  // dotted, empty for the root
    const YamlNode* node;
    int line = 0;
    std::set<std::string> known;
    std::set<std::string> read;

    std::string full_key(const std::string& key) const {
      return name.empty() || key.empty() ? name + key : name + "." + key;
    }
  };

  std::filesystem::path file;
  YamlNode root;
  std::vector<Record> records;

  [[noreturn]] void fail(int line, const std::string& key, const std::string& what) const {
    throw FileError(file, line, key, what);
  }
};

/// What stands behind a key.
struct Section::Value {
  const YamlNode& node;
  int line;
  std::string key;  // dotted
  const Document& document;

  [[noreturn]] void fail(const std::string& what) const { document.fail(line, key, what); }

  const std::string& scalar(const std::string& wanted) const {
    if (node.kind == YamlNode::Kind::Empty) fail("has no value; give " + wanted);
    if (node.kind != YamlNode::Kind::Scalar) {
      fail(std::string("is ") + describe(node.kind) + "; give " + wanted);
    }
    return node.scalar;
  }

  const std::string& unquoted(const std::string& wanted) const {
    const std::string& text = scalar(wanted);
    if (!node.is_plain) fail("'" + text + "' is in quotes, so a text; remove the quotes");
    return text;
  }

  /// What parse_number or parse_integer makes of it.
  template <class Number>
  Number parsed(Number (*parse)(std::string_view)) const {
    try {
      return parse(unquoted("a number"));
    } catch (const std::invalid_argument& error) {
      fail(error.what());
    }
  }

  /// Numbers of a list, the lists in it (rows of a matrix) in order.
  void append_numbers(std::vector<double>& numbers, int depth) const {
    if (node.kind != YamlNode::Kind::List || depth > 1) {
      fail(std::string("is ") + describe(node.kind) + "; give a list of numbers");
    }
    for (const YamlNode& item : node.list) {
      const Value element{item, item.line, key, document};
      if (item.kind == YamlNode::Kind::List) {
        element.append_numbers(numbers, depth + 1);
      } else {
        numbers.push_back(element.parsed(parse_number));
      }
    }
  }
};

}  // namespace kestrel
