#include "kestrel/io/yaml_section.hpp"

#include "yaml_document.hpp"

namespace kestrel {

std::vector<SectionItem> Section::items(const std::string& key) const {
  const Value v = value(key);
  if (v.node.kind == YamlNode::Kind::Scalar) return {{v.scalar("a word"), std::nullopt}};
  if (v.node.kind != YamlNode::Kind::List) {
    v.fail(std::string("is ") + describe(v.node.kind) + "; give a list");
  }
  std::vector<SectionItem> items;
  for (const YamlNode& node : v.node.list) {
    const std::string name = v.key + "[" + std::to_string(items.size() + 1) + "]";
    const Value item{node, node.line, name, *document_};
    if (node.kind == YamlNode::Kind::Map) {
      items.push_back({"", opened(name, node, node.line)});
    } else {
      items.push_back({item.scalar("a word, or keys in braces"), std::nullopt});
      if (items.back().word.empty()) item.fail("is an empty text; give one");
    }
  }
  return items;
}

std::vector<std::string> Section::words(const std::string& key) const {
  std::vector<std::string> words;
  for (const SectionItem& item : items(key)) {
    if (item.keys) fail(key, "has keys where words are wanted; give words");
    words.push_back(item.word);
  }
  return words;
}

std::vector<std::string> Section::keys() const {
  std::vector<std::string> keys;
  for (const auto& entry : document_->records[record_].node->entries) keys.push_back(entry.key);
  return keys;
}

Section Section::opened(const std::string& name, const YamlNode& node, int line) const {
  for (std::size_t i = 0; i < document_->records.size(); ++i) {
    if (document_->records[i].name == name) return {document_, i};
  }
  document_->records.push_back({name, &node, line, {}, {}});
  return {document_, document_->records.size() - 1};
}

}  // namespace kestrel
