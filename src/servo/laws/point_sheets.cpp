#include <map>

#include "sheets.hpp"

namespace kestrel::laws {
namespace {

const char* const kSurvey = "Chaumette & Hutchinson 2006, Visual servo control, part I";

LawSheet cur() {
  return {
      "Current interaction matrix",
      "v = -lambda L(s, Z)^+ e",
      "the depth Z of every point, now",
      std::string(kSurvey) + "; Espiau, Chaumette & Rives 1992; ViSP: CURRENT",
      "When depths are known and the turn about the optical axis is small: the error decays as "
      "exp(-lambda t) and the points move on straight lines in the image, so they stay in view.",
      "A turn th about the optical axis makes the camera retreat to Z* / cos(th/2), without end "
      "at 180 degrees. Far from the goal four points have local minima, where the camera stops. "
      "A depth k times too large makes the translation k times as fast: unstable with delay."};
}

LawSheet cur_zdes() {
  return {
      "Current points, depths of the goal",
      "v = -lambda L(s, Z*)^+ e",
      "Z* only",
      std::string(kSurvey) + "; ViSP: CURRENT when set_Z is not called again",
      "When nothing measures depth: the translation starts at the speed the goal's depth tells, "
      "lambda times the way for a parallel target.",
      "Far away (Z > Z*) the points no longer move straight. Only first order near the goal. "
      "Under a turn about the optical axis it retreats too."};
}

LawSheet cur_zarea() {
  return {
      "Current points, one depth from the area",
      "v = -lambda L(s, Z)^+ e with Z = Z* sqrt(a*/a), a the area of the points' polygon",
      "Z* and points in the order of a polygon",
      "The depth of a plane parallel to the image goes with 1/sqrt(area): Tahri & Chaumette 2005",
      "When the target faces the camera: it is then cur, without any pose.",
      "A target seen at a slant looks smaller, hence farther than it is: the translation is too "
      "fast. Noise of the corners is noise of the depth."};
}

LawSheet cur_zhomog() {
  return {"Current points, depths from the homography",
          "v = -lambda L(s, Z)^+ e with Z_i = Z*_i (H m*_i)_3, H scaled to second singular value 1",
          "Z* and the Euclidean homography of the target's plane from the goal's view to this one",
          "Malis, Chaumette & Boudet 1999 (ratio of depths); Ma, Soatto, Kosecka & Sastry 2004 "
          "(scale of H)",
          "In place of cur when a tracker gives a homography: exact, and H need not be decomposed.",
          "As cur. A homography from four noisy corners of a small target carries their noise "
          "into every depth. Wrong for points off the plane."};
}

LawSheet des() {
  return {"Interaction matrix of the goal",
          "v = -lambda L(s*, Z*)^+ e",
          "s* and Z* only: the matrix is constant",
          std::string(kSurvey) + "; Espiau, Chaumette & Rives 1992; ViSP: DESIRED (cached)",
          "Near the goal, where depth cannot be measured, or every microsecond counts: one product "
          "per frame, and no noise in the matrix.",
          "A turn th about the optical axis makes the camera advance: at 135 degrees it comes as "
          "near as 0.19 Z*, from about 147 degrees on it hits the target. Far away it is slow, "
          "Z*/Z; nearer than the goal it is fast. Image paths bend: points may leave the image."};
}

LawSheet mean() {
  return {
      "Mean of the two interaction matrices",
      "v = -lambda ((L + L*) / 2)^+ e",
      "the depth Z of every point now, and Z*",
      "Malis 2004 (efficient second-order minimisation); " + std::string(kSurvey) + "; ViSP: MEAN",
      "The first choice: right to second order, so a wide start still gives a short camera "
      "path. Neither retreats nor advances under a turn about the optical axis.",
      "Turns at 2 lambda tan(th/2) about the axis: fast beyond 120 degrees, singular at 180. "
      "With depths that are not kept up to date it silently is mean_zdes, of first order."};
}

LawSheet mean_zdes() {
  return {
      "Mean of the two matrices, both with the goal's depths",
      "v = -lambda ((L(s, Z*) + L*) / 2)^+ e",
      "Z* only",
      "What ViSP's MEAN becomes when the depths are not set again; compare Malis 2004",
      "To see what mean loses without depths. Translations start 2 / (1 + Z/Z*) as fast as "
      "they should.",
      "Only of first order: the reason to use a mean is gone when the distance changes. Singular "
      "as mean at a half turn."};
}

LawSheet mjp() {
  return {"Mean of the two pseudo-inverses",
          "v = -lambda (L^+ + L*^+) / 2 e",
          "the depth Z of every point now, and Z*",
          "Malis 2004; Tahri & Mezouar 2010",
          "As mean, where the mean matrix would be near singular: each inverse exists by itself. "
          "The turn about the axis goes with sin(th): never violent.",
          "Second order with an error some ten times that of mean. A turn of nearly 180 degrees "
          "takes long to begin, and at 180 it stands still. Two inversions."};
}

LawSheet pmj_r() {
  return {"Mean of the matrices, the goal's turned into the camera",
          "v = -lambda ((L + L* diag(R, R)) / 2)^+ e, R = c*_R_c",
          "Z, Z* and the rotation from the camera to the goal",
          "Tahri & Mezouar 2010",
          "When a rotation is known (homography, attitude): second order towards the straight "
          "line, R^T t and theta u, for which mean is only of first order.",
          "Of first order towards the screw. Far from the goal the sum of the two matrices can be "
          "singular: the smallest basin of the means."};
}

LawSheet pmj_t() {
  return {"Mean of the matrices, the goal's moved into the camera",
          "v = -lambda ((L + L* Ad) / 2)^+ e, Ad = [R [t]x R; 0 R] of c*_M_c",
          "Z, Z* and the pose of the camera in the goal's camera",
          "Tahri & Mezouar 2010 (the full change of frame)",
          "To tell what the frame of L* matters: of second order towards the screw.",
          "Needs the pose that a pose-based law would servo on directly. Singular sums as pmj_r."};
}

}  // namespace

const LawSheet& sheet_of_point_law(Law law) {
  static const std::map<Law, LawSheet> sheets = {{Law::Cur, cur()},
                                                 {Law::CurZdes, cur_zdes()},
                                                 {Law::CurZarea, cur_zarea()},
                                                 {Law::CurZhomog, cur_zhomog()},
                                                 {Law::Des, des()},
                                                 {Law::Mean, mean()},
                                                 {Law::MeanZdes, mean_zdes()},
                                                 {Law::Mjp, mjp()},
                                                 {Law::PmjR, pmj_r()},
                                                 {Law::PmjT, pmj_t()}};
  return sheets.at(law);
}

}  // namespace kestrel::laws
