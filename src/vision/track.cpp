#include "kestrel/vision/track.hpp"

namespace kestrel {

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
