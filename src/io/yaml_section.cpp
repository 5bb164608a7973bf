#include "kestrel/io/yaml_section.hpp"

#include "yaml_document.hpp"

namespace kestrel {

Section::Section(std::shared_ptr<Document> document, std::size_t record)
    : document_(std::move(document)), record_(record) {}
Section Section::load(const std::filesystem::path& file) { return parse(file, read_text(file)); }
Section Section::parse(const std::filesystem::path& name, const std::string& text) {
  const auto document = std::make_shared<Document>();
  document->file = name;
  document->root = parse_yaml(name, text);
  document->records.push_back({"", &document->root, 1, {}, {}});
  return {document, 0};
}

Section::Value Section::value(const std::string& key) const {
  Document::Record& record = document_->records[record_];
  record.known.insert(key);
  record.read.insert(key);
  if (const auto* entry = record.node->find(key)) {
    return {entry->value, entry->line, record.full_key(key), *document_};
  }
  std::vector<std::string> unread;
  for (const auto& entry : record.node->entries) {
    if (record.read.count(entry.key) == 0) unread.push_back(entry.key);
  }
  const std::string near = nearest_word(key, unread);
  document_->fail(
      record.line, record.full_key(key),
      near.empty() ? "is missing; add it" : "is missing; did you mean it by " + near + "?");
}

bool Section::has(const std::string& key) const {
  Document::Record& record = document_->records[record_];
  record.known.insert(key);
  return record.node->find(key) != nullptr;
}

double Section::number(const std::string& k) const { return value(k).parsed(parse_number); }
std::int64_t Section::integer(const std::string& k) const { return value(k).parsed(parse_integer); }

int Section::whole(const std::string& key, int otherwise) const {
  const std::int64_t wide = integer(key, otherwise);
  if (wide != int(wide)) fail(key, std::to_string(wide) + " is too large; write a smaller number");
  return int(wide);
}

std::string Section::text(const std::string& key) const {
  const Value v = value(key);
  const std::string& text = v.scalar("a text");
  if (text.empty()) v.fail("is an empty text; give one");
  return text;
}

bool Section::flag(const std::string& key, bool otherwise) const {
  if (!has(key)) return otherwise;
  const Value v = value(key);
  const std::string& word = v.unquoted("true or false");
  if (word != "true" && word != "false") v.fail("is '" + word + "'; write true or false");
  return word == "true";
}

std::vector<double> Section::numbers(const std::string& key) const {
  std::vector<double> list;
  value(key).append_numbers(list, 0);
  return list;
}

std::vector<double> Section::numbers(const std::string& key, std::size_t count) const {
  std::vector<double> list = numbers(key);
  if (list.size() != count) {
    fail(key, "has " + std::to_string(list.size()) + " numbers; give " + std::to_string(count));
  }
  return list;
}

std::filesystem::path Section::path(const std::string& key) const {
  return (document_->file.parent_path() / text(key)).lexically_normal();
}

Section Section::child(const std::string& key) const {
  const Value v = value(key);
  if (v.node.kind != YamlNode::Kind::Map) {
    v.fail(std::string("is ") + describe(v.node.kind) + "; write keys below it");
  }
  return opened(v.key, v.node, v.line);
}

std::size_t Section::one_of(const std::string& key, const std::vector<std::string>& words) const {
  const Value v = value(key);
  const std::string& said = v.scalar("one of the words");
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == said) return i;
    list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  }
  v.fail("is '" + said + "'; write " + list);
}

void Section::fail(const std::string& key, const std::string& what) const {
  const Document::Record& record = document_->records[record_];
  const auto* entry = record.node->find(key);
  document_->fail(entry != nullptr ? entry->line : record.line, record.full_key(key), what);
}

void Section::done() const {
  for (const Document::Record& record : document_->records) {
    const std::vector<std::string> known(record.known.begin(), record.known.end());
    for (const auto& entry : record.node->entries) {
      if (record.read.count(entry.key) != 0) continue;
      std::string what = "is no key here; remove it";
      const std::string near = nearest_word(entry.key, known);
      if (!near.empty()) what = "is no key here; did you mean " + near + "?";
      if (record.known.count(entry.key) != 0)
        what = "has no effect beside the other keys; remove it";
      document_->fail(entry.line, record.full_key(entry.key), what);
    }
  }
}

const std::filesystem::path& Section::file() const { return document_->file; }

}  // namespace kestrel
