#include <map>

#include "sheets.hpp"

namespace kestrel::laws {
namespace {

LawSheet polar() {
  return {"Points in polar coordinates",
          "v = -lambda L_polar^+ e, features (rho, theta) of each point, differences of theta "
          "wrapped into a half turn",
          "the depth Z of every point, now",
          "Iwatsuki & Okiyama 2005; Corke, Spindler & Chaumette 2009; ViSP: vpFeaturePointPolar",
          "Large turns about the optical axis: theta turns, rho stays, the camera neither retreats "
          "nor advances.",
          "Not defined for a point on the optical axis, and wild near it. Pure translations, "
          "straight for cur, become long detours."};
}

LawSheet partition() {
  return {
      "Optical axis apart",
      "vz = lambda Z* ln(sigma*/sigma), wz = lambda wrap(theta - theta*), the other four "
      "-L_xy^+ (lambda e + L_z (vz, wz)); sigma = sqrt(area), theta the angle of the first edge",
      "Z of every point and Z*, of at least four points",
      "Corke & Hutchinson 2001",
      "Large turns about the optical axis with points: the axis is servoed by its own two "
      "features, so there is no retreat.",
      "Area and edge of a slanted target speak of the slant too. A target that tilts "
      "disturbs vz; the four others share the weak sideways and tilt directions of points."};
}

LawSheet two_and_half_d() {
  return {"2 1/2 D: one point, its depth ratio, the rotation",
          "w = -lambda theta u; v = -Lv^-1 (lambda (X - X*, Y - Y*, ln(Z/Z*)) + Lw w)",
          "the poses of the target in the camera and in the goal's camera; the reference point "
          "is the target's origin",
          "Malis, Chaumette & Boudet 1999; Malis & Chaumette 2000",
          "From anywhere: rotation and translation are decoupled, the reference point moves on a "
          "straight line in the image, no local minima.",
          "The rotation comes from a decomposition: noise of a small target is noise of the tilt. "
          "Only one point is kept in view."};
}

LawSheet homog() {
  return {"Straight from the homography",
          "v = lambda Z* (H - I) m*, w = (lambda/2) vex(H - H^T), H from goal to camera, "
          "m* = (0, 0, 1)",
          "the Euclidean homography; Z* is only a gain",
          "Benhimane & Malis 2007",
          "When a tracker gives a homography and nothing else is known of the target: no pose, no "
          "decomposition.",
          "The modes have the rates lambda {1, 1, 1 +- 1/sqrt(2)}: it is 3.4 times slower than its "
          "gain says. Convergence is proved near the goal only."};
}

LawSheet pbvs_ct() {
  return {"Pose: the camera on a straight line",
          "w = -lambda theta u; v = -lambda R^T c*_t_c",
          "the pose of the camera in the goal's camera",
          "Chaumette & Hutchinson 2006, part I; Wilson, Hulls & Bell 1996",
          "The reference in space: the shortest way, from everywhere, at one rate.",
          "Nothing keeps the target in the image. The pose's noise and the target's size, if "
          "wrong, go straight to the command."};
}

LawSheet pbvs_co() {
  return {"Pose: the target's centre on a straight line",
          "w = -lambda theta u; v = -lambda ((c*_t_o - c_t_o) + [c_t_o]x theta u)",
          "the poses of the target in the camera and in the goal's camera",
          "Chaumette & Hutchinson 2006, part I",
          "Pose-based, with the centre of the target kept in view: it moves straight in the "
          "camera's frame.",
          "The camera's own way bends and gets long for large turns. Noise and model as pbvs_ct."};
}

LawSheet screw() {
  return {"Pose: the screw motion to the goal",
          "v = -lambda log(c*_M_c)",
          "the pose of the camera in the goal's camera",
          "The logarithm of SE(3): Murray, Li & Sastry 1994; what mean approximates to second "
          "order",
          "The yardstick of the means: one constant twist, scaled, leads to the goal.",
          "Translation bends along the screw: with a large turn the camera swings wide, and "
          "the target may leave the image."};
}

LawSheet moments() {
  return {"Moments: centre, size, skewness and orientation of the outline",
          "v = -lambda L_m^+ (xn - xn*, yn - yn*, an - an*, sx - sx*, sy - sy*, alpha - alpha*), "
          "an = Z* sqrt(a*/a), (xn, yn) = an (xg, yg) of the area within the points' outline; "
          "sx + i sy = 180 e^(-i alpha) ((mu30 + mu12) + i (mu03 + mu21)) / (a^(5/2) sqrt(a*)); "
          "alpha is the turn that lays the points seen on those wanted, for 1/2 atan2(2 mu11, "
          "mu20 - mu02) is not defined for a square",
          "Z* of at least four points; no depth of the view: its plane is taken to be that of the "
          "goal, turned by alpha and moved by an",
          "Chaumette 2004; Tahri & Chaumette 2005; ViSP: vpFeatureMoment*; sx, sy and alpha in "
          "this form are our own",
          "A target parallel to the image: L is minus identity on the translations, so they are "
          "decoupled, equally conditioned and straight. Good for the four freedoms of a "
          "helicopter.",
          "The matrix is exact near the goal and wherever the plane is turned and moved only; a "
          "slant far from the goal's is told badly. The tilt rests on third moments, which noise "
          "reaches first."};
}

LawSheet decoupled() {
  return {"Three references from centre and size",
          "vz = lambda (Zh - Z*), vx = lambda Zh (xg - xg*), vy = lambda Zh (yg - yg*), no rates, "
          "Zh = Z* sqrt(a*/a); (xg, yg) the mean of the points",
          "Z* of at least four points",
          "In the manner of Mejias, Saripalli, Campoy & Sukhatme 2006; the metric form is our own",
          "The simplest thing that flies: no matrix, each axis by itself, perfect conditioning.",
          "Heading must be held by somebody else: a heading error psi parks the camera Z* tan(psi) "
          "aside. Tilt of camera or target is taken for a displacement."};
}

}  // namespace

const LawSheet& sheet_of_feature_law(Law law) {
  static const std::map<Law, LawSheet> sheets = {
      {Law::Polar, polar()}, {Law::Partition, partition()}, {Law::TwoAndHalfD, two_and_half_d()},
      {Law::Homog, homog()}, {Law::PbvsCt, pbvs_ct()},      {Law::PbvsCo, pbvs_co()},
      {Law::Screw, screw()}, {Law::Moments, moments()},     {Law::Decoupled, decoupled()}};
  return sheets.at(law);
}

}  // namespace kestrel::laws
