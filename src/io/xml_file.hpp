#pragma once

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "kestrel/io/text_file.hpp"

namespace kestrel {

/// An XML file with the line of each of its elements.
class Xml {
 public:
  explicit Xml(const std::filesystem::path& file) : file_(file), text_(read_text(file)) {
    const auto result = document_.load_buffer(text_.data(), text_.size());
    if (!result) {
      throw FileError(file_, line_at(result.offset), "",
                      std::string("is no XML (") + result.description() + "); correct it");
    }
  }

  pugi::xml_node root() const { return document_.document_element(); }

  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const {
    throw FileError(file_, line_at(node.offset_debug()), node.name(), what);
  }

  /// The only child of this name.
  pugi::xml_node child(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node node = parent.child(name);
    if (!node) fail(parent, std::string("<") + name + "> is missing in it; add it");
    if (node.next_sibling(name)) fail(node.next_sibling(name), "is given twice; remove one");
    return node;
  }

  double number(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node node = child(parent, name);
    return numbers_of(node, 1)[0];
  }

  /// Numbers separated by white space; count 0: any.
  std::vector<double> numbers_of(const pugi::xml_node& node, std::size_t count) const {
    std::istringstream words(node.text().get());
    std::vector<double> list;
    try {
      for (std::string word; words >> word;) list.push_back(parse_number(word));
    } catch (const std::invalid_argument& error) {
      fail(node, error.what());
    }
    if (count != 0 && list.size() != count) {
      fail(node, "has " + std::to_string(list.size()) + " numbers; give " + std::to_string(count));
    }
    return list;
  }

  int size(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node node = parent.child(name);
    if (!node) return 0;
    const double value = numbers_of(node, 1)[0];
    if (!(value >= 1 && value <= 1e6 && value == int(value))) fail(node, "is no size in pixels");
    return int(value);
  }

 private:
  int line_at(std::ptrdiff_t offset) const {
    const auto end =
        text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ptrdiff_t(text_.size()));
    return 1 + int(std::count(text_.begin(), end, '\n'));
  }

  std::filesystem::path file_;
  std::string text_;
  pugi::xml_document document_;
};

}  // namespace kestrel
