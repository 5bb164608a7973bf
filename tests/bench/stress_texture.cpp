#include "bench/stress_texture.hpp"

#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

namespace kestrel::test {
namespace {

const char* const kOpenCv = "/usr/share/doc/opencv-doc/examples/";
const char* const kVisp = "/usr/share/visp-images-data/ViSP-images/";

}  // namespace

std::vector<StressTexture> stress_textures() {
  const std::string cv = kOpenCv;
  const std::string visp = kVisp;
  const auto dev = StressSet::Dev;
  const auto held_out = StressSet::HeldOut;
  return {
      {"graffiti", dev, cv + "data/graf1.png", cv + "data/leuvenA.jpg"},
      {"box", dev, cv + "data/box.png", cv + "data/building.jpg"},
      {"board", dev, cv + "data/board.jpg", cv + "data/aloeL.jpg"},
      {"leaves", dev, cv + "alphamat/input_images/plant.jpg", cv + "data/home.jpg"},
      {"text", dev, cv + "data/imageTextN.png", cv + "data/rubberwhale1.png"},
      {"aerial", dev, cv + "data/aero1.jpg", cv + "data/fruits.jpg"},
      {"painting", held_out, cv + "data/starry_night.jpg", cv + "text/scenetext01.jpg"},
      {"butterfly", held_out, cv + "data/butterfly.jpg", cv + "text/scenetext05.jpg"},
      {"gold", held_out, visp + "Klimt/Klimt.pgm", cv + "text/scenetext03.jpg"},
      {"shop", held_out, cv + "text/scenetext06.jpg", cv + "data/squirrel_cls.jpg"},
      {"sudoku", held_out, cv + "data/sudoku.png", cv + "data/chicky_512.png"},
      {"comic", held_out, visp + "cube/image.0000.pgm", cv + "text/scenetext04.jpg"},
  };
}

std::vector<std::string> texture_names(StressSet set) {
  std::vector<std::string> names;
  for (const StressTexture& texture : stress_textures()) {
    if (texture.set == set) names.push_back(texture.name);
  }
  return names;
}

StressTexture stress_texture(const std::string& name) {
  for (const StressTexture& texture : stress_textures()) {
    if (texture.name == name) return texture;
  }
  throw std::invalid_argument("texture: there is none named " + name);
}

cv::Mat load_picture(const std::string& file) {
  cv::Mat gray = cv::imread(file, cv::IMREAD_GRAYSCALE);
  if (gray.empty()) {
    throw std::runtime_error(file +
                             ": cannot be read; install Debian's opencv-doc and visp-images-data");
  }
  return gray;
}

}  // namespace kestrel::test
