#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace kestrel {

/// The conditions after each word of the modifier ("kz2_d3") has changed them, checked.
template <class C, class WithWord>
C with_words(const C& conditions, const std::string& modifier, const WithWord& with_word) {
  C changed = conditions;
  for (std::size_t begin = 0; begin < modifier.size();) {
    const std::size_t end = std::min(modifier.find('_', begin), modifier.size());
    changed = with_word(changed, modifier.substr(begin, end - begin));
    begin = end + 1;
  }
  changed.check();
  return changed;
}

/// The finite number that a word is from this letter on; empty when that is none.
inline std::optional<double> number_behind(const std::string& word, std::size_t letters) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(word.substr(letters), &used);
  } catch (const std::logic_error&) {
    return std::nullopt;
  }
  if (letters + used != word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace kestrel
