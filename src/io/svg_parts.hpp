#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "kestrel/io/markup.hpp"

/// Pieces that all SVG pictures of this layer share.
namespace kestrel::svg {

inline constexpr int kColours = 7;

/// Okabe & Ito's palette without yellow (unreadable on white); the darker ones lighter on a dark
/// page.
inline constexpr std::string_view kStyle =
    ".kt{fill:#2e3440;font:12px system-ui,-apple-system,'Segoe UI',sans-serif}"
    ".kh{font-weight:600;font-size:15px}.kn{fill:#5d6672;font-size:11px}"
    ".kg{stroke:#e3e7ec;stroke-width:1}.kf{stroke:#9aa3ae;fill:none;stroke-width:1}"
    ".kl{fill:none;stroke-width:1.7;stroke-linejoin:round;stroke-linecap:round}"
    ".kd{stroke-dasharray:6 4;stroke-linecap:butt}.kp{stroke-dasharray:1.5 3;stroke-linecap:butt}"
    ".kq{stroke-dasharray:9 3 2 3;stroke-linecap:butt}.ke{font-size:11px}.ka{opacity:.5}"
    ".kz{stroke:#8b95a1!important;stroke-width:1.2}"
    ".km{stroke:#b3261e;stroke-width:1;stroke-dasharray:2 3}.kr{fill:#b3261e;font-size:11px}"
    ".c0{stroke:#0072b2}.c1{stroke:#d55e00}.c2{stroke:#009e73}.c3{stroke:#cc79a7}"
    ".c4{stroke:#e69f00}.c5{stroke:#56b4e9}.c6{stroke:#2e3440}"
    ".b0{fill:#0072b2}.b1{fill:#d55e00}.b2{fill:#009e73}.b3{fill:#cc79a7}"
    ".b4{fill:#e69f00}.b5{fill:#56b4e9}.b6{fill:#2e3440}"
    "@media(prefers-color-scheme:dark){.kt{fill:#d8dee6}.kn{fill:#9aa5b1}.kg{stroke:#2b323b}"
    ".kf{stroke:#6b7683}.km{stroke:#ff8a80}.kr{fill:#ff8a80}"
    ".c0{stroke:#3f9fe0}.c1{stroke:#f0803c}.c2{stroke:#1fbd92}.c5{stroke:#8fd0f5}"
    ".c6{stroke:#d8dee6}.b0{fill:#3f9fe0}.b1{fill:#f0803c}.b2{fill:#1fbd92}.b5{fill:#8fd0f5}"
    ".b6{fill:#d8dee6}}"
    "@media print{.kt{fill:#2e3440}.kg{stroke:#e3e7ec}}";

/// About the width of a text of 12 px type, px.
inline double text_width(std::string_view text) {
  double width = 0;
  for (const char c : text) width += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 6.9 : 0;
  return width;
}

inline std::string text(double x, double y, std::string_view anchor, std::string_view classes,
                        std::string_view words) {
  return fmt::format(
      "<text class=\"kt{}{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n",
      classes.empty() ? "" : " ", classes, x, y, anchor, escaped(words));
}

inline std::string line(double x1, double y1, double x2, double y2, std::string_view classes) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", classes, x1,
      y1, x2, y2);
}

/// A whole document around body, named for readers of the screen by label.
inline std::string document(double width, double height, std::string_view label,
                            std::string_view body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
      "height=\"{1:g}\" role=\"img\" aria-label=\"{2}\">\n<style>{3}</style>\n{4}</svg>\n",
      width, height, escaped(label), kStyle, body);
}

}  // namespace kestrel::svg
