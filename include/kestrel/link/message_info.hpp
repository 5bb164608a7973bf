#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

// The tables of MAVLink messages, for what looks at frames without knowing their meaning: routing,
// logs, tests.
namespace kestrel::mavlink {

constexpr std::size_t kMaxPayload = 255;

/// Type of a field, or of the elements of an array.
enum class FieldType { Char, UInt8, Int8, UInt16, Int16, UInt32, Int32, UInt64, Int64, Float };

/// As message definitions write it: "char", "uint8_t", ..., "float".
constexpr std::string_view name(FieldType type) {
  constexpr std::string_view kNames[] = {"char",     "uint8_t", "int8_t",   "uint16_t", "int16_t",
                                         "uint32_t", "int32_t", "uint64_t", "int64_t",  "float"};
  return kNames[std::size_t(type)];
}

/// Bytes of one element.
constexpr std::size_t size_of(FieldType type) {
  constexpr std::size_t kSizes[] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4};
  return kSizes[std::size_t(type)];
}

/// A field and its place in the payload.
struct FieldInfo {
  std::string_view name;  // as in the message definition
  FieldType type = FieldType::UInt8;
  std::uint8_t count = 0;   // elements of an array; 0 for what is no array
  std::uint8_t offset = 0;  // bytes from the start of the payload
  bool extension = false;   // appended to the message after it was first published

  constexpr std::size_t size() const { return size_of(type) * (count > 0 ? count : 1); }
};

/// A message as published: what its frames are checked against.
struct MessageInfo {
  std::uint32_t id = 0;
  std::string_view name;
  std::uint8_t crc_extra = 0;
  std::uint8_t length = 0;   // bytes of the payload without extensions, before trimming
  std::uint8_t longest = 0;  // with them
  const FieldInfo* fields = nullptr;
  std::size_t field_count = 0;

  constexpr const FieldInfo* begin() const { return fields; }
  constexpr const FieldInfo* end() const { return fields + field_count; }
  /// The field of that name, or nullptr.
  const FieldInfo* field(std::string_view field_name) const;
};

/// A list that lives as long as the program.
struct MessageInfos {
  const MessageInfo* first = nullptr;
  std::size_t count = 0;

  const MessageInfo* begin() const { return first; }
  const MessageInfo* end() const { return first + count; }
};

/// Every message that Kestrel knows, by rising id.
MessageInfos message_infos();

/// What is known of a message, or nullptr.
const MessageInfo* message_info(std::uint32_t id);

}  // namespace kestrel::mavlink
