#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kestrel::test {

/// What is wrong with the nesting of the tags of an XML or HTML text; empty when it is well formed:
/// every element is closed in order, attributes are quoted, no stray < or & is in the text. The
/// content of <style> and <script> is skipped; elements that HTML never closes may stand alone.
inline std::string markup_fault(std::string_view text) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '&') {
      const std::size_t end = text.find(';', at);
      if (end == std::string_view::npos || end - at > 7) return "stray & at " + std::to_string(at);
      at = end + 1;
      continue;
    }
    if (text[at] != '<') {
      if (text[at] == '>') return "stray > at " + std::to_string(at);
      ++at;
      continue;
    }
    std::size_t end = at + 1;
    for (char quote = 0; end < text.size() && (quote || text[end] != '>'); ++end) {
      if (!quote && (text[end] == '"' || text[end] == '\''))
        quote = text[end];
      else if (text[end] == quote)
        quote = 0;
      if (text[end] == '<') return "< inside a tag at " + std::to_string(end);
    }
    if (end >= text.size()) return "tag without end at " + std::to_string(at);
    const std::string tag(text.substr(at + 1, end - at - 1));
    at = end + 1;
    if (tag.rfind("!DOCTYPE", 0) == 0) continue;
    const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
    if (name.front() == '/') {
      if (open.empty() || "/" + open.back() != name) return "unexpected <" + name + ">";
      open.pop_back();
      continue;
    }
    const bool is_alone = tag.back() == '/' || name == "meta" || name == "img" || name == "link";
    if (!is_alone) open.push_back(name);
    if (name == "style" || name == "script") at = text.find("</" + name + ">", at);
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

}  // namespace kestrel::test
