#include "kestrel/vision/track.hpp"

namespace kestrel {

std::optional<StraightView> straight_view(const Track& track, double width_px, double height_px,
                                          const Camera& camera) {
  if (track.straight_from_template)
    return StraightView{*track.straight_from_template, without_lens(camera)};
  if (!track.found()) return std::nullopt;
  return straight_view(*track.image_from_template, width_px, height_px, camera);
}

const char* name(TrackStatus status) {
  switch (status) {
    case TrackStatus::Found:
      return "found";
    case TrackStatus::Coasting:
      return "coasting";
    case TrackStatus::Lost:
      return "lost";
  }
  return "unknown";
}

const char* name(Miss miss) {
  switch (miss) {
    case Miss::None:
      return "found";
    case Miss::NoImage:
      return "no_image";
    case Miss::FewKeypoints:
      return "few_keypoints";
    case Miss::FewMatches:
      return "few_matches";
    case Miss::NoConsensus:
      return "no_consensus";
    case Miss::BadOutline:
      return "bad_outline";
    case Miss::Undetermined:
      return "undetermined";
    case Miss::NotAlike:
      return "not_alike";
    case Miss::Ambiguous:
      return "ambiguous";
  }
  return "unknown";
}

const char* name(TrackStage stage) {
  switch (stage) {
    case TrackStage::None:
      return "none";
    case TrackStage::Aligned:
      return "aligned";
    case TrackStage::Searched:
      return "searched";
    case TrackStage::Detected:
      return "detected";
  }
  return "unknown";
}

}  // namespace kestrel
