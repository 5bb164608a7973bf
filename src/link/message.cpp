#include "kestrel/link/message.hpp"

#include <algorithm>
#include <cstring>

#include "layouts/command_layouts.hpp"
#include "layouts/measurement_layouts.hpp"
#include "layouts/motion_layouts.hpp"
#include "layouts/time_layouts.hpp"
#include "layouts/vehicle_layouts.hpp"

namespace kestrel::mavlink {
namespace {

/// Little-endian on any machine.
template <class T>
void store(const T& value, std::uint8_t* to) {
  if constexpr (Shape<T>::kCount > 0) {
    for (const auto& element : value) {
      store(element, to);
      to += sizeof element;
    }
  } else if constexpr (std::is_same_v<T, float>) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    store(bits, to);
  } else {
    const auto bits = std::make_unsigned_t<T>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) to[i] = std::uint8_t(bits >> (8 * i));
  }
}

template <class T>
void load(T& value, const std::uint8_t* from) {
  if constexpr (Shape<T>::kCount > 0) {
    for (auto& element : value) {
      load(element, from);
      from += sizeof element;
    }
  } else if constexpr (std::is_same_v<T, float>) {
    std::uint32_t bits = 0;
    load(bits, from);
    std::memcpy(&value, &bits, sizeof value);
  } else {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) bits |= std::uint64_t(from[i]) << (8 * i);
    value = T(std::make_unsigned_t<T>(bits));
  }
}

template <class M>
void store_fields(const M& message, std::uint8_t* to) {
  const auto put = [&](const auto& value) {
    store(value, to);
    to += sizeof value;
  };
  std::apply([&](const auto&... f) { (put(message.*f.member), ...); }, all_fields<M>());
}

/// From a payload of kMaxPayload bytes.
template <class M>
Message load_fields(const std::uint8_t* from) {
  M message;
  const auto take = [&](auto& value) {
    load(value, from);
    from += sizeof value;
  };
  std::apply([&](const auto&... f) { (take(message.*f.member), ...); }, all_fields<M>());
  return message;
}

template <class M>
constexpr MessageInfo info() {
  return {Layout<M>::kId,
          Layout<M>::kName,
          Layout<M>::kCrcExtra,
          std::uint8_t(Layout<M>::kLength),
          std::uint8_t(Extensions<M>::kLongest),
          kFieldInfos<M>.data(),
          kFieldInfos<M>.size()};
}

using Load = Message (*)(const std::uint8_t*);

/// One line for each message of the variant, in its order.
template <class Variant>
struct Tables;
template <class... M>
struct Tables<std::variant<M...>> {
  static constexpr std::array<MessageInfo, sizeof...(M)> kInfos = {info<M>()...};
  static constexpr std::array<Load, sizeof...(M)> kLoads = {load_fields<M>...};
};
constexpr const auto& kInfos = Tables<Message>::kInfos;
constexpr const auto& kLoads = Tables<Message>::kLoads;

constexpr bool ids_rise() {
  for (std::size_t i = 1; i < kInfos.size(); ++i) {
    if (kInfos[i - 1].id >= kInfos[i].id) return false;
  }
  return true;
}
static_assert(ids_rise(), "message_info searches by halves");

}  // namespace

MessageInfos message_infos() { return {kInfos.data(), kInfos.size()}; }

const MessageInfo* message_info(std::uint32_t id) {
  const auto found = std::lower_bound(
      kInfos.begin(), kInfos.end(), id,
      [](const MessageInfo& each, std::uint32_t wanted) { return each.id < wanted; });
  return found == kInfos.end() || found->id != id ? nullptr : &*found;
}

const FieldInfo* MessageInfo::field(std::string_view field_name) const {
  const auto* found =
      std::find_if(begin(), end(), [&](const FieldInfo& each) { return each.name == field_name; });
  return found == end() ? nullptr : found;
}

const MessageInfo& info_of(const Message& message) { return kInfos[message.index()]; }

Payload payload_of(const Message& message) {
  Payload payload;
  std::visit([&](const auto& m) { store_fields(m, payload.data.data()); }, message);
  payload.size = info_of(message).longest;
  while (payload.size > 1 && payload.data[payload.size - 1] == 0) --payload.size;
  return payload;
}

std::optional<Message> message_of(std::uint32_t id, Bytes payload) {
  const MessageInfo* const info = message_info(id);
  if (info == nullptr) return std::nullopt;
  std::array<std::uint8_t, kMaxPayload> whole{};
  std::copy_n(payload.data, std::min(payload.size, whole.size()), whole.begin());
  return kLoads[std::size_t(info - kInfos.data())](whole.data());
}

}  // namespace kestrel::mavlink
