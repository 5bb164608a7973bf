#include "kestrel/vision/feature_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/random.hpp"
#include "support/sift_pictures.hpp"

namespace kestrel {
namespace {

/// A descriptor of random bins; most of them small, as SIFT's are.
Descriptor any_descriptor(test::Random& random) {
  std::array<double, 128> share{};
  double sum = 0;
  for (double& s : share) sum += s = std::pow(random.uniform(0, 1), 3);
  Descriptor result;
  for (std::size_t b = 0; b < 128; ++b)
    result.bin[b] = std::uint8_t(std::min(127., std::round(256 * std::sqrt(share[b] / sum))));
  return result;
}

/// The same, some bins a little different.
Descriptor similar(const Descriptor& descriptor, int change, test::Random& random) {
  Descriptor result = descriptor;
  for (std::uint8_t& bin : result.bin)
    bin = std::uint8_t(std::clamp(int(bin) + random.integer(-change, 0), 0, 127));
  return result;
}

LearnedFeature feature(double u, double v, int view = 0) {
  return {{u, v}, Eigen::Matrix2f::Identity(), 1, view};
}

struct Scene {
  LearnedFeatures model;
  SiftPoints image;
};

/// The model's features 10 px apart; those of even number are in the image too, 100 px to the
/// right.
Scene any_scene(int features, int others, test::Random& random) {
  Scene scene;
  for (int i = 0; i < features; ++i) {
    scene.model.at.push_back(feature(10. * (i % 20), 10. * double(i / 20)));
    scene.model.descriptors.push_back(any_descriptor(random));
    if (i % 2 == 1) continue;
    const Pixel at = scene.model.at.back().in_template;
    scene.image.at.push_back({float(at.u + 100), float(at.v), 2, 0, 1});
    scene.image.descriptors.push_back(similar(scene.model.descriptors.back(), 6, random));
  }
  for (int i = 0; i < others; ++i) {
    scene.image.at.push_back({float(10 * i), 500, 2, 0, 1});
    scene.image.descriptors.push_back(any_descriptor(random));
  }
  return scene;
}

/// What match promises, written down again: mutual nearest neighbours by squared distance (of
/// equal ones the first), ratio against the nearest at another place.
std::vector<AffinePair> by_definition(const Scene& scene, const FeatureMatchOptions& options) {
  const auto far = [&](const Pixel& a, const Pixel& b) {
    return distance(a, b) > options.same_place_px;
  };
  const auto& [model, image] = scene;
  std::vector<AffinePair> pairs;
  for (std::size_t j = 0; j < image.at.size(); ++j) {
    const std::size_t i = test::nearest(image.descriptors[j], model.descriptors);
    if (test::nearest(model.descriptors[i], image.descriptors) != j) continue;
    double second = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < model.at.size(); ++k)
      if (far(model.at[k].in_template, model.at[i].in_template))
        second = std::min(
            second, double(test::squared_distance(image.descriptors[j], model.descriptors[k])));
    const double first = test::squared_distance(image.descriptors[j], model.descriptors[i]);
    const float ratio = std::sqrt(float(first) / float(second));
    if (std::isinf(second) || second == 0 || double(ratio) >= options.ratio) continue;
    pairs.push_back({model.at[i].in_template,
                     {double(image.at[j].u), double(image.at[j].v)},
                     Eigen::Matrix2f::Identity(),
                     ratio,
                     int(i),
                     int(j)});
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
  std::vector<AffinePair> kept;
  for (const AffinePair& p : pairs) {
    const bool is_new = std::all_of(kept.begin(), kept.end(), [&](const AffinePair& k) {
      return far(k.in_template, p.in_template) && far(k.in_image, p.in_image);
    });
    if (is_new && int(kept.size()) < options.max_pairs) kept.push_back(p);
  }
  return kept;
}

void expect_same(const std::vector<AffinePair>& a, const std::vector<AffinePair>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].template_index, b[k].template_index);
    EXPECT_EQ(a[k].image_index, b[k].image_index);
    EXPECT_EQ(a[k].ratio, b[k].ratio);
  }
}

TEST(FeatureMatch, IsTheExactSearchItPromises) {
  test::Random random("exact");
  for (const auto& [features, others] : {std::pair(60, 30), {1, 5}, {7, 2}, {9, 0}, {133, 61}}) {
    Scene scene = any_scene(features, others, random);
    // Views repeat a place, and an image keypoint may have two orientations.
    for (int i = 0; i < features; i += 3) {
      const std::size_t k = std::size_t(i);
      scene.model.at.push_back(
          feature(scene.model.at[k].in_template.u + 1, scene.model.at[k].in_template.v, 2));
      scene.model.descriptors.push_back(similar(scene.model.descriptors[k], 8, random));
    }
    scene.image.at.push_back(scene.image.at[0]);
    scene.image.descriptors.push_back(similar(scene.image.descriptors[0], 4, random));
    FeatureMatchOptions options;
    for (const Simd simd : {Simd::Auto, Simd::Baseline}) {
      options.simd = simd;
      expect_same(match_features(scene.model, scene.image, options), by_definition(scene, options));
    }
    if (features > 8) {
      EXPECT_FALSE(by_definition(scene, options).empty());
    }
  }
}

// Bins of 127 in the same 16 places: the products are as large as 16 bits must hold.
TEST(FeatureMatch, BearsTheLargestBins) {
  Scene scene;
  for (int i = 0; i < 12; ++i) {
    Descriptor descriptor;
    for (std::size_t b = 0; b < 4; ++b) descriptor.bin[std::size_t(8 * i) + b] = 127;
    scene.model.at.push_back(feature(10 * i, 0));
    scene.model.descriptors.push_back(descriptor);
    scene.image.at.push_back({float(10 * i), 50, 2, 0, 1});
    descriptor.bin[std::size_t(8 * i) + 4] = 20;
    scene.image.descriptors.push_back(descriptor);
  }
  FeatureMatchOptions options;
  for (const Simd simd : {Simd::Auto, Simd::Baseline}) {
    options.simd = simd;
    const auto pairs = match_features(scene.model, scene.image, options);
    ASSERT_EQ(pairs.size(), 12U);
    for (const AffinePair& p : pairs) {
      EXPECT_EQ(p.template_index, p.image_index);
      EXPECT_EQ(p.ratio, std::sqrt(400.F / (8 * 127 * 127 + 400)));
    }
  }
}

TEST(FeatureMatch, IsOneToOneInPlaces) {
  test::Random random("places");
  Scene scene = any_scene(40, 0, random);
  const std::size_t count = scene.image.at.size();
  for (std::size_t j = 0; j < count; ++j) {  // again, a px away, of another view
    scene.model.at.push_back(
        feature(scene.model.at[2 * j].in_template.u + 1, scene.model.at[2 * j].in_template.v, 1));
    scene.model.descriptors.push_back(any_descriptor(random));
    SiftPoint point = scene.image.at[j];
    point.v += 100;
    scene.image.at.push_back(point);
    scene.image.descriptors.push_back(similar(scene.model.descriptors.back(), 3, random));
  }
  EXPECT_EQ(match_features(scene.model, scene.image, {}).size(), count);
  FeatureMatchOptions narrow;
  narrow.same_place_px = 0.5;
  EXPECT_EQ(match_features(scene.model, scene.image, narrow).size(), 2 * count);
}

TEST(FeatureMatch, KeepsTheMostDistinctive) {
  test::Random random("distinctive");
  const Scene scene = any_scene(60, 10, random);
  const auto all = match_features(scene.model, scene.image, {});
  ASSERT_GT(all.size(), 20U);
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(),
                             [](const auto& a, const auto& b) { return a.ratio < b.ratio; }));
  FeatureMatchOptions few;
  few.max_pairs = 5;
  const auto some = match_features(scene.model, scene.image, few);
  ASSERT_EQ(some.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(some[k].image_index, all[k].image_index);
}

// A keypoint of scale s and angle a that the template shows at scale t and angle b: the map turns
// by a - b and enlarges by s / t.
TEST(FeatureMatch, PredictsTheAffineMap) {
  test::Random random("affine");
  Scene scene = any_scene(30, 0, random);
  for (LearnedFeature& f : scene.model.at) {
    const float b = 0.3F;
    f.from_template << std::cos(b), std::sin(b), -std::sin(b), std::cos(b);
    f.from_template /= 1.5F;
  }
  for (SiftPoint& p : scene.image.at) {
    p.scale_px = 3;
    p.angle_rad = 1.1F;
  }
  Eigen::Matrix2f expected;
  expected << std::cos(0.8F), -std::sin(0.8F), std::sin(0.8F), std::cos(0.8F);
  expected *= 2;
  const auto pairs = match_features(scene.model, scene.image, {});
  ASSERT_FALSE(pairs.empty());
  for (const AffinePair& p : pairs) EXPECT_LT((p.image_from_template - expected).norm(), 1e-5);
}

TEST(FeatureMatch, KeepsItsMemoryNotItsAnswers) {
  test::Random random("memory");
  const Scene scene = any_scene(50, 20, random);
  Scene other = any_scene(50, 40, random);
  FeatureMatcher matcher(scene.model, {});
  const auto first = matcher.match(scene.image);
  matcher.match(other.image);
  expect_same(first, matcher.match(scene.image));
  EXPECT_TRUE(matcher.match({}).empty());
  EXPECT_TRUE(FeatureMatcher({}, {}).match(scene.image).empty());
}

TEST(FeatureMatch, RefusesWhatIsNoDescriptor) {
  test::Random random("refuses");
  Scene scene = any_scene(20, 0, random);
  scene.image.descriptors[3].bin[5] = 128;
  EXPECT_THROW(match_features(scene.model, scene.image, {}), std::invalid_argument);
  scene.image.descriptors[3].bin.fill(60);
  EXPECT_THROW(match_features(scene.model, scene.image, {}), std::invalid_argument);
  scene.image.descriptors.pop_back();
  EXPECT_THROW(match_features(scene.model, scene.image, {}), std::invalid_argument);
  scene.model.descriptors[2].bin[0] = 200;
  EXPECT_THROW(FeatureMatcher(scene.model, {}), std::invalid_argument);
  scene.model.descriptors.pop_back();
  EXPECT_THROW(FeatureMatcher(scene.model, {}), std::invalid_argument);
}

TEST(FeatureMatchOptions, NamesWhatIsOutOfRange) {
  EXPECT_NO_THROW(FeatureMatchOptions().check());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double ratio : {0.0, 1.1, nan}) {
    FeatureMatchOptions options;
    options.ratio = ratio;
    EXPECT_THROW(options.check(), std::invalid_argument);
  }
  FeatureMatchOptions options;
  options.max_pairs = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options.max_pairs = 1;
  options.same_place_px = nan;
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace kestrel
