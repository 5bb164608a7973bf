#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "kestrel/link/crc.hpp"
#include "kestrel/link/message_info.hpp"

// The tables of the codec. A new message is a struct, a Layout and a place in the variant; the
// asserts beside the Layouts compare its names, types, order and length with the published ones.
namespace kestrel::mavlink {

template <class Struct, class Value>
struct Field {
  using Type = Value;
  std::string_view name;  // as in the message definition
  Value Struct::*member;
};

template <class Struct, class Value>
constexpr Field<Struct, Value> field(std::string_view name, Value Struct::*member) {
  return {name, member};
}

/// The message's name, id, published CRC_EXTRA and length, and its fields in the order of the
/// wire: by falling size of their type, else as defined. With extensions also kExtensions, as
/// defined, and kLongest, the length with them.
template <class M>
struct Layout;

/// Type of one element, and how many there are; 0 for what is no array.
template <class T>
struct Shape {
  using Element = T;
  static constexpr std::uint8_t kCount = 0;
};
template <class T, std::size_t N>
struct Shape<std::array<T, N>> {
  using Element = T;
  static constexpr std::uint8_t kCount = N;
};

template <class F>
using FieldShape = Shape<typename std::decay_t<F>::Type>;
template <class F>
using FieldElement = typename FieldShape<F>::Element;

template <class T>
constexpr FieldType field_type() {
  if constexpr (std::is_same_v<T, char>) return FieldType::Char;
  if constexpr (std::is_same_v<T, std::uint8_t>) return FieldType::UInt8;
  if constexpr (std::is_same_v<T, std::int8_t>) return FieldType::Int8;
  if constexpr (std::is_same_v<T, std::uint16_t>) return FieldType::UInt16;
  if constexpr (std::is_same_v<T, std::int16_t>) return FieldType::Int16;
  if constexpr (std::is_same_v<T, std::uint32_t>) return FieldType::UInt32;
  if constexpr (std::is_same_v<T, std::int32_t>) return FieldType::Int32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return FieldType::UInt64;
  if constexpr (std::is_same_v<T, std::int64_t>) return FieldType::Int64;
  if constexpr (std::is_same_v<T, float>) return FieldType::Float;
}

/// Extensions of a message; none as a rule.
template <class M, class = void>
struct Extensions {
  static constexpr auto kFields = std::make_tuple();
  static constexpr std::size_t kLongest = Layout<M>::kLength;
};
template <class M>
struct Extensions<M, std::void_t<decltype(Layout<M>::kExtensions)>> {
  static constexpr auto kFields = Layout<M>::kExtensions;
  static constexpr std::size_t kLongest = Layout<M>::kLongest;
};

template <class M>
constexpr auto all_fields() {
  return std::tuple_cat(Layout<M>::kFields, Extensions<M>::kFields);
}

/// The fields of a message, with their places in the payload.
template <class M>
constexpr auto field_infos() {
  constexpr auto kFields = all_fields<M>();
  constexpr std::size_t kCount = std::tuple_size_v<decltype(kFields)>;
  constexpr std::size_t kBase = std::tuple_size_v<decltype(Layout<M>::kFields)>;
  std::array<FieldInfo, kCount> infos{};
  std::size_t i = 0, offset = 0;
  const auto add = [&](const auto& f) {
    using F = std::decay_t<decltype(f)>;
    infos[i] = {f.name, field_type<FieldElement<F>>(), FieldShape<F>::kCount, std::uint8_t(offset),
                i >= kBase};
    offset += sizeof(typename F::Type);
    ++i;
  };
  std::apply([&](const auto&... f) { (add(f), ...); }, kFields);
  return infos;
}

template <class M>
inline constexpr auto kFieldInfos = field_infos<M>();

constexpr std::uint16_t crc_add(std::uint16_t crc, std::string_view text) {
  for (const char letter : text) {
    crc = kestrel::crc_add(crc, static_cast<std::uint8_t>(letter));
  }
  return kestrel::crc_add(crc, std::uint8_t{' '});
}

/// The byte that makes the checksum depend on the definition: the checksum of its name, then of
/// each field's type, name and count if it is an array, folded to eight bits; extensions do not
/// count (mavlink.io, "CRC_EXTRA Calculation").
template <class M>
constexpr std::uint8_t crc_extra() {
  std::uint16_t crc = crc_add(kCrcStart, Layout<M>::kName);
  for (const FieldInfo& f : kFieldInfos<M>) {
    if (f.extension) break;
    crc = crc_add(crc_add(crc, name(f.type)), f.name);
    if (f.count > 0) crc = kestrel::crc_add(crc, f.count);
  }
  return static_cast<std::uint8_t>((crc & 0xFF) ^ (crc >> 8));
}

/// Bytes of the payload before trimming, with extensions or without.
template <class M>
constexpr std::size_t length(bool extended) {
  std::size_t total = 0;
  for (const FieldInfo& f : kFieldInfos<M>) {
    if (!f.extension || extended) total += f.size();
  }
  return total;
}

template <class M>
constexpr bool as_published() {
  return crc_extra<M>() == Layout<M>::kCrcExtra && length<M>(false) == Layout<M>::kLength &&
         length<M>(true) == Extensions<M>::kLongest && length<M>(true) <= kMaxPayload;
}

}  // namespace kestrel::mavlink
