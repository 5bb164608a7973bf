#include "kestrel/io/yaml_tree.hpp"

#include <set>
#include <sstream>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

namespace kestrel {
namespace {

namespace fs = std::filesystem;

constexpr int kMostValues = 100000;

/// Hears where a document starts, and nothing else.
class DocumentStart : public YAML::EventHandler {
 public:
  int line() const { return line_; }

  void OnDocumentStart(const YAML::Mark& mark) override { line_ = mark.line + 1; }  // NOLINT
  void OnDocumentEnd() override {}                                                  // NOLINT
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}                        // NOLINT
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}                       // NOLINT
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,              // NOLINT
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,  // NOLINT
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}                                        // NOLINT
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,  // NOLINT
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}  // NOLINT

 private:
  int line_ = 0;
};

/// Copies yaml-cpp's nodes and refuses what a file of ours must not have.
class Copier {
 public:
  explicit Copier(const fs::path& file) : file_(file) {}

  YamlNode copy(const YAML::Node& node, const std::string& name) {
    YamlNode copied;
    copied.line = node.Mark().line + 1;
    if (++count_ > kMostValues) {
      throw FileError(file_, copied.line, name, "the file has too many values; use fewer aliases");
    }
    if (node.IsScalar()) {
      copied.kind = YamlNode::Kind::Scalar;
      copied.scalar = node.Scalar();
      copied.is_plain = node.Tag() != "!";
    } else if (node.IsSequence()) {
      copied.kind = YamlNode::Kind::List;
      for (const auto& item : node) copied.list.push_back(copy(item, name));
    } else if (node.IsMap()) {
      copied.kind = YamlNode::Kind::Map;
      for (const auto& entry : node) copied.entries.push_back(copy_entry(entry, copied, name));
    }
    return copied;
  }

 private:
  YamlNode::Entry copy_entry(const YAML::detail::iterator_value& entry, const YamlNode& map,
                             const std::string& name) {
    const int line = entry.first.Mark().line + 1;
    if (!entry.first.IsScalar()) throw FileError(file_, line, name, "a key must be a single word");
    const std::string key = entry.first.Scalar();
    const std::string full = name.empty() ? key : name + "." + key;
    if (map.find(key) != nullptr) {
      throw FileError(file_, line, full, "is given twice; remove one of the two");
    }
    return {key, line, copy(entry.second, full)};
  }

  const fs::path& file_;
  int count_ = 0;
};

/// yaml-cpp's Load drops whatever follows the first document without a word, and its LoadAll may
/// never end on a stray bracket there: so the text is heard once before it is loaded.
void require_one_document(const fs::path& file, const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStart heard;
  if (parser.HandleNextDocument(heard) && parser.HandleNextDocument(heard)) {
    throw FileError(file, heard.line(), "",
                    "begins a second document (`---` or a stray bracket); remove it");
  }
}

}  // namespace

const YamlNode::Entry* YamlNode::find(const std::string& key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

YamlNode parse_yaml(const fs::path& file, const std::string& text) {
  try {
    require_one_document(file, text);
    const YAML::Node root = YAML::Load(text);
    if (!root || root.IsNull()) throw FileError(file, 0, "", "is empty; write `key: value` lines");
    YamlNode tree = Copier(file).copy(root, "");
    if (tree.kind != YamlNode::Kind::Map) {
      throw FileError(
          file, tree.line, "",
          std::string("the file is ") + describe(tree.kind) + "; write `key: value` lines");
    }
    return tree;
  } catch (const YAML::Exception& error) {
    const bool tab = text.find('\t') != std::string::npos;
    throw FileError(file, error.mark.line + 1, "",
                    "is no YAML (" + error.msg + "); " +
                        (tab ? "use spaces in place of tabs" : "check indentation and brackets"));
  }
}

const char* describe(YamlNode::Kind kind) {
  switch (kind) {
    case YamlNode::Kind::Scalar:
      return "a text or number";
    case YamlNode::Kind::List:
      return "a list";
    case YamlNode::Kind::Map:
      return "a section of keys";
    case YamlNode::Kind::Empty:
      break;
  }
  return "empty";
}

}  // namespace kestrel
