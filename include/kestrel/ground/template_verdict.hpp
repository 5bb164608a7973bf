#pragma once

#include <string>

#include "kestrel/vision/template.hpp"
#include "kestrel/vision/track_options.hpp"

namespace kestrel {

/// How good a template is, before anything depends on it.
struct TemplateVerdict {
  enum class Grade { Good, Fair, Poor };
  Grade grade = Grade::Poor;
  std::string words;  // why, in one sentence
  int keypoints = 0;  // learned, all views together
  int blocks = 0;     // textured, of 8x8 px, of the finest level
  /// The share of the nine parts of the rectangle (thirds of width and height) with texture, 0 to
  /// 1: what is seen of a template whose texture is in one corner says little of its far corner.
  double spread = 0;
  /// See SelfLikeness: above a half it is about as like itself elsewhere as it is here.
  double self_likeness = 0;
  int likeness_places = 0;  // where it is like itself
};

/// "good", "fair", "poor".
const char* name(TemplateVerdict::Grade grade);

/// Fair below kSomeSpread or from kSomeLikeness on; poor from kMuchLikeness on (a chessboard), with
/// texture in three parts of nine or fewer, or with hardly more blocks than the tracker must see
/// alike. A template that cannot be learned at all has no verdict: Template refuses it.
TemplateVerdict template_verdict(const Template& model, const TrackOptions& options);

constexpr double kSomeSpread = 0.6;
constexpr double kSomeLikeness = 0.25;
constexpr double kMuchLikeness = 0.5;

}  // namespace kestrel
