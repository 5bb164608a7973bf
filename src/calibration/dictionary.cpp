#include "dictionary.hpp"

#include <utility>

#include <opencv2/aruco/dictionary.hpp>

namespace kestrel {

std::optional<int> marker_dictionary(const std::string& name) {
  using namespace cv::aruco;  // NOLINT(google-build-using-namespace): a list of its names
  static const std::pair<const char*, int> known[] = {
      {"4X4_50", DICT_4X4_50},
      {"4X4_100", DICT_4X4_100},
      {"4X4_250", DICT_4X4_250},
      {"4X4_1000", DICT_4X4_1000},
      {"5X5_50", DICT_5X5_50},
      {"5X5_100", DICT_5X5_100},
      {"5X5_250", DICT_5X5_250},
      {"5X5_1000", DICT_5X5_1000},
      {"6X6_50", DICT_6X6_50},
      {"6X6_100", DICT_6X6_100},
      {"6X6_250", DICT_6X6_250},
      {"6X6_1000", DICT_6X6_1000},
      {"7X7_50", DICT_7X7_50},
      {"7X7_100", DICT_7X7_100},
      {"7X7_250", DICT_7X7_250},
      {"7X7_1000", DICT_7X7_1000},
      {"ARUCO_ORIGINAL", DICT_ARUCO_ORIGINAL},
  };
  for (const auto& [word, number] : known)
    if (name == word) return number;
  return std::nullopt;
}

}  // namespace kestrel
