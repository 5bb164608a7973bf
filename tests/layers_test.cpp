// The law of the layers: who may include whom, and which library lives where. It reads every
// #include below include/, src/ and tests/ and names the file and the include that breaks it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// layer -> layers it may include, itself apart.
const std::map<std::string, Names> kMayInclude = {
    {"geometry", {}},
    {"vision", {"geometry"}},
    {"servo", {"geometry"}},
    {"vehicle", {"geometry"}},
    {"loop", {"geometry", "vision", "servo", "vehicle"}},
    {"link", {"geometry", "vehicle"}},
    {"io", {"geometry", "vision", "servo", "vehicle", "loop"}},
    {"sim", {"geometry", "vision", "servo", "vehicle", "loop"}},
    {"eval", {"geometry", "vision", "servo", "vehicle", "loop", "io"}},
    {"ground", {"geometry", "vision", "servo", "vehicle", "loop", "link", "io"}},
    {"lab", {"geometry", "vision", "servo", "vehicle", "loop", "io", "sim", "eval"}},
    {"calibration", {"geometry", "vision", "servo", "vehicle", "loop", "io", "eval"}},
    {"app",
     {"geometry", "vision", "servo", "vehicle", "loop", "link", "io", "sim", "eval", "ground",
      "lab", "calibration"}},
};

/// An include that starts like this -> layers or files (below src/ or include/kestrel/) that may
/// have it.
const std::vector<std::pair<std::string, Names>> kLibraryHomes = {
    {"visp3/", {"servo", "calibration/visp_module", "app/display_module", "app/plot_module"}},
    {"yaml-cpp/", {"io/yaml_tree"}},
    {"pugixml.hpp", {"io/xml_file"}},
    {"CLI/", {"app"}},
    {"sys/socket.h", {"link"}},
    {"netinet/", {"link"}},
    {"arpa/", {"link"}},
    {"netdb.h", {"link"}},
    {"dc1394/", {"io/dc1394_bus"}},
    {"libav",
     {"io/libav", "io/libav_decoder", "io/network_camera", "io/video_reader", "io/video_encoder"}},
    {"libsw", {"io/libav"}},
    {"png.h", {"io/png_image"}},
    {"sodium.h", {"link", "ground/access_token"}},
    {"httplib.h", {"ground/http_connection"}},
    {"openssl/", {"ground/guarded_server", "ground/http_connection", "ground/tls_identity"}},
    {"boost/", {"sim"}},
    {"jpeglib.h", {"io/jpeg_image"}},
    {"dlfcn.h", {"io/module"}},
    {"linux/videodev2.h", {"io/v4l2_device"}},
    {"sys/ioctl.h", {"io/device_calls"}},
    {"opencv2/videoio", {}},
    {"opencv2/imgcodecs", {"io/image_module"}},
    {"opencv2/highgui", {}},
    {"nlohmann/", {"io", "link", "eval", "ground", "lab", "calibration", "app"}},
    {"opencv2/aruco", {"calibration"}},
    {"opencv2/", {"vision", "loop", "io", "sim", "ground", "calibration", "app"}},
};

/// What a public header may show besides the standard library and Kestrel itself.
const std::map<std::string, Names> kHeaderShows = {
    {"vision", {"Eigen/", "opencv2/core"}},      {"loop", {"Eigen/", "opencv2/core"}},
    {"io", {"Eigen/", "opencv2/core"}},          {"sim", {"Eigen/", "opencv2/core"}},
    {"calibration", {"Eigen/", "opencv2/core"}}, {"ground", {"Eigen/", "opencv2/core"}},
};

struct Include {
  std::string unit;   // "servo/servo"
  std::string layer;  // "servo"
  std::string what;   // "visp3/vs/vpServo.h"
  bool header = false;
};

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

std::vector<Include> includes_below(const fs::path& root, bool headers) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
    const fs::path unit = fs::relative(entry.path(), root).replace_extension();
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, pattern)) continue;
      found.push_back({unit.string(), unit.begin()->string(), match[1], headers});
    }
  }
  return found;
}

/// Why an include is against the law; empty when it is not.
std::string offence(const Include& include) {
  const std::string& what = include.what;
  if (starts_with(what, "kestrel/")) {
    const std::string other = what.substr(8, what.find('/', 8) - 8);
    if (other == include.layer || kMayInclude.at(include.layer).count(other) > 0) return "";
    return include.unit + " includes " + what + ": " + include.layer + " must not know " + other;
  }
  for (const auto& [start, homes] : kLibraryHomes) {
    if (!starts_with(what, start)) continue;
    const bool home = homes.count(include.layer) > 0 || homes.count(include.unit) > 0;
    if (!home) return include.unit + " includes " + what + ": not the home of " + start;
  }
  const bool third_party = what.find('/') != std::string::npos;
  if (include.header && third_party && include.layer != "app") {
    const auto shows = kHeaderShows.find(include.layer);
    const Names allowed = shows == kHeaderShows.end() ? Names{"Eigen/"} : shows->second;
    const bool shown = std::any_of(allowed.begin(), allowed.end(), [&](const std::string& start) {
      return starts_with(what, start);
    });
    if (!shown) return "the public header of " + include.unit + " shows " + what;
  }
  return "";
}

TEST(Layers, EveryIncludeGoesDown) {
  const fs::path root(KESTREL_SOURCE_DIR);
  std::vector<Include> all = includes_below(root / "include" / "kestrel", true);
  const std::vector<Include> sources = includes_below(root / "src", false);
  all.insert(all.end(), sources.begin(), sources.end());
  ASSERT_GT(all.size(), 100u) << "the sources were not found";
  for (const Include& include : all) {
    ASSERT_EQ(kMayInclude.count(include.layer), 1u) << include.layer << " is no layer";
    const std::string why = offence(include);
    EXPECT_EQ(why, "");
  }
}

TEST(Layers, TheLawCanBeBroken) {
  EXPECT_NE(offence({"vision/track", "vision", "kestrel/servo/servo.hpp", false}), "");
  EXPECT_NE(offence({"loop/step", "loop", "visp3/core/vpConfig.h", false}), "");
  EXPECT_NE(offence({"link/socket", "link", "kestrel/loop/step.hpp", false}), "");
  EXPECT_NE(offence({"io/task_file", "io", "yaml-cpp/yaml.h", false}), "");
  EXPECT_NE(offence({"app/servo", "app", "sys/socket.h", false}), "");
  EXPECT_NE(offence({"vehicle/limits", "vehicle", "opencv2/core.hpp", false}), "");
  EXPECT_NE(offence({"io/report", "io", "nlohmann/json.hpp", true}), "");
  EXPECT_NE(offence({"io/report", "io", "opencv2/imgcodecs.hpp", false}), "");
  EXPECT_NE(offence({"app/servo", "app", "httplib.h", false}), "");
  EXPECT_NE(offence({"ground/ground_desk", "ground", "kestrel/sim/world.hpp", false}), "");
  EXPECT_NE(offence({"app/display", "app", "visp3/gui/vpDisplayX.h", false}), "");
  EXPECT_EQ(offence({"servo/servo", "servo", "visp3/vs/vpServo.h", false}), "");
  EXPECT_EQ(offence({"app/main", "app", "kestrel/sim/world.hpp", false}), "");
}

TEST(Layers, EveryUnitHasHeaderAndTest) {
  const fs::path root(KESTREL_SOURCE_DIR);
  for (const auto& entry : fs::recursive_directory_iterator(root / "include" / "kestrel")) {
    if (entry.path().extension() != ".hpp") continue;
    fs::path unit = fs::relative(entry.path(), root / "include" / "kestrel");
    unit.replace_extension();
    EXPECT_TRUE(fs::exists(root / "tests" / (unit.string() + "_test.cpp")))
        << unit << " has no test";
  }
}

}  // namespace
