#include <map>

#include "sheets.hpp"

namespace kestrel::laws {
namespace {

LawSheet lm() {
  return {"Damped least squares (Levenberg-Marquardt)",
          "v = -lambda (L^T L + mu diag(L^T L))^-1 L^T e",
          "the depth Z of every point, now",
          "Marquardt 1963; as ViSP's photometric example servoes, Collewet & Marchand 2011",
          "Near singular configurations: what the points hardly show is answered softly in place "
          "of wildly. mu = 0 is cur, a large mu the transpose.",
          "The weak directions, sideways against tilt, slow down first: at mu = 1e-4 they keep 0.6 "
          "of lambda, at 1e-2 they do not settle in 50 s. It minimises |e|, so local minima of "
          "cur stay."};
}

LawSheet transpose() {
  return {"Transpose, scaled",
          "v = -lambda L^T e / sigma^2, sigma the largest singular value of L",
          "the depth Z of every point, now",
          "Steepest descent of |e|^2 / 2; ViSP: TRANSPOSE, there without the scale; scaled by the "
          "curvature so that the fastest mode has the rate lambda",
          "As a teaching piece: no inverse, no singularity, and always downhill.",
          "The rates of the modes differ by the square of the condition: 14 000 for the square at "
          "0.75 m. Sideways and tilt take hours to come apart."};
}

LawSheet transpose_raw() {
  return {"Transpose as it is",
          "v = -lambda L^T e",
          "the depth Z of every point, now",
          "ViSP: TRANSPOSE",
          "To show what the scale of a Jacobian means: gain and units are mixed up in it.",
          "For the square at 0.75 m the modes run from 8e-4 to 11.3 lambda: the gain that is "
          "stable for the fastest is nothing for the slowest. Nearer, it is unstable earlier."};
}

LawSheet broyden() {
  return {"Jacobian learned by secants, gated and aligned",
          "v = -lambda J^+ e, J <- J + (ds - J dx) dx^T / (dx^T dx) each time |ds| > gate, J0 = L*",
          "Z* for the start, and how the camera moved between two images",
          "Broyden 1965; Hosoda & Asada 1994; Jagersand, Fuentes & Nelson 1997",
          "When calibration or depth is doubtful: a depth that is wrong by half at the start does "
          "not slow it down, as it forgets the start.",
          "It knows only the directions it has flown. Below the gate it learns nothing; a target "
          "that moves by itself teaches it nonsense. The motion must be that between the images, "
          "not the command just sent."};
}

LawSheet broyden_raw() {
  return {"Jacobian learned by secants at every step",
          "v = -lambda J^+ e, J <- J + (ds - J dx) dx^T / (dx^T dx), J0 = L*",
          "Z* for the start, and how the camera moved between two images",
          "Broyden 1965; Hosoda & Asada 1994",
          "To see why the gate is there; without noise and delay it is the faster learner.",
          "Near the goal dx is small and ds is noise: half a pixel unlearns the Jacobian. A motion "
          "that is a frame off flies into the target."};
}

LawSheet rls() {
  return {"Jacobian learned by recursive least squares",
          "v = -lambda J^+ e, J <- J + (ds - J dx) dx^T P / (f + dx^T P dx), "
          "P <- (P - P dx dx^T P / (f + dx^T P dx)) / f, J0 = L*, P0 = p I",
          "Z* for the start, and how the camera moved between two images",
          "Piepmeier, McMurray & Lipkin 2004",
          "When several past motions shall count, the last ones most (f = 0.95: some twenty "
          "frames): less nervous than one secant.",
          "Fast but violent: with a large P0 the first frames rewrite the whole Jacobian, so limit "
          "the speed. With little motion P grows and the next noise is believed."};
}

}  // namespace

const LawSheet& sheet_of_search_law(Law law) {
  static const std::map<Law, LawSheet> sheets = {{Law::Lm, lm()},
                                                 {Law::Transpose, transpose()},
                                                 {Law::TransposeRaw, transpose_raw()},
                                                 {Law::Broyden, broyden()},
                                                 {Law::BroydenRaw, broyden_raw()},
                                                 {Law::Rls, rls()}};
  return sheets.at(law);
}

}  // namespace kestrel::laws
