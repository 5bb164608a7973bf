#pragma once

#include <regex>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace kestrel::test {

/// The vertices of the first line of the first colour in a picture of io/svg_space, px; empty when
/// it has none.
inline std::vector<Eigen::Vector2d> first_line(const std::string& svg) {
  std::vector<Eigen::Vector2d> out;
  const std::regex path("<path class=\"kl c0\" d=\"([^\"]*)\"");
  const std::regex vertex("[ML](-?[0-9.]+) (-?[0-9.]+)");
  std::smatch found;
  if (!std::regex_search(svg, found, path)) return out;
  const std::string d = found[1];
  for (std::sregex_iterator v(d.begin(), d.end(), vertex), end; v != end; ++v)
    out.emplace_back(std::stod((*v)[1]), std::stod((*v)[2]));
  return out;
}

}  // namespace kestrel::test
