#include <array>
#include <cmath>
#include <complex>

#include "kestrel/geometry/rotation.hpp"

#include "laws.hpp"
#include "outline.hpp"
#include "outline_motion.hpp"
#include "point_features.hpp"
#include "pseudo_inverse.hpp"

namespace kestrel::laws {
namespace {

using Complex = std::complex<double>;

/// (mu30 + mu12) + i (mu03 + mu21): turns with the image like a vector, zero for an outline that is
/// its own image under half a turn.
Complex skewness(const Outline& o) { return {o.mu(3, 0) + o.mu(1, 2), o.mu(0, 3) + o.mu(2, 1)}; }

/// Sum of conj(p*_i - mean) (p_i - mean): its argument is the rotation between the two views of
/// labelled points (least squares, Umeyama 1991 in the plane).
Complex alignment(const std::vector<Complex>& desired, const std::vector<Complex>& measured) {
  Complex sum = 0;
  for (std::size_t i = 0; i < desired.size(); ++i) sum += std::conj(desired[i]) * measured[i];
  return sum;
}

std::vector<Complex> about_mean(const std::vector<Feature>& points) {
  Complex mean = 0;
  for (const Feature& f : points) mean += Complex(f.at.x, f.at.y) / double(points.size());
  std::vector<Complex> centred;
  centred.reserve(points.size());
  for (const Feature& f : points) centred.push_back(Complex(f.at.x, f.at.y) - mean);
  return centred;
}

/// What the law looks at, of both views.
struct View {
  Outline now;
  Outline goal;
  std::vector<Complex> goal_points;  // about their mean
  Complex aligned;                   // its argument is alpha - alpha*
  PlaneDepth goal_plane;
  double goal_depth_m = 0;  // Z*, of the plane at the centre
  double an_m = 0;          // Z* sqrt(a* / a)

  double turn() const { return std::arg(aligned); }
};

View view_of(const LawInput& input) {
  const auto order = outline_order(input.desired);
  View v{Outline(input.measured, order), Outline(input.desired, order), about_mean(input.desired),
         0, plane_depth(input.desired)};
  v.aligned = alignment(v.goal_points, about_mean(input.measured));
  v.goal_depth_m = 1 / v.goal_plane.inverse_depth_at(v.goal.centre());
  v.an_m = v.goal_depth_m * std::sqrt(v.goal.area() / v.now.area());
  return v;
}

/// The plane as the law believes it to be: that of the goal, turned and moved with the outline.
PlaneDepth believed_plane(const View& v) {
  const double scale = v.goal_depth_m / v.an_m;
  const Complex slope = scale * Complex(v.goal_plane.A, v.goal_plane.B) * std::polar(1.0, v.turn());
  return {slope.real(), slope.imag(),
          1 / v.an_m - slope.real() * v.now.centre().x() - slope.imag() * v.now.centre().y()};
}

/// The tilt features are scaled so that a square seen square on answers a unit of wx or wy by one.
double tilt_scale(const View& v) { return 180 / std::sqrt(v.goal.area()); }

Complex tilt(const View& v, const Outline& o, double turned) {
  return tilt_scale(v) * std::polar(std::pow(o.area(), -2.5), -turned) * skewness(o);
}

/// s - s* of (xn, yn, an, sx, sy, alpha).
Eigen::VectorXd error_of(const View& v) {
  const Eigen::Vector2d n = v.an_m * v.now.centre() - v.goal_depth_m * v.goal.centre();
  const Complex s = tilt(v, v.now, v.turn()) - tilt(v, v.goal, 0);
  Vector6d error;
  error << n, v.an_m - v.goal_depth_m, s.real(), s.imag(), v.turn();
  return error;
}

/// Rate of alpha: of the argument of the alignment, from the rates of the points.
double turn_rate(const View& v, const std::vector<Feature>& points, const ImageField& field) {
  Complex rate = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d p = field.at({points[i].at.x, points[i].at.y});
    rate += std::conj(v.goal_points[i]) * Complex(p.x(), p.y());
  }
  return (rate / v.aligned).imag();
}

/// The column of the interaction matrix that belongs to the image's motion under a unit twist.
Vector6d column(const View& v, const std::vector<Feature>& points, const ImageField& field) {
  const OutlineRates rates = outline_rates(v.now, field);
  const double growth = rates.area / v.now.area();
  const double an_rate = -v.an_m * growth / 2;
  const double alpha_rate = turn_rate(v, points, field);
  const Complex q = skewness(v.now);
  const Complex q_rate(rates.mu30 + rates.mu12, rates.mu03 + rates.mu21);
  const Complex s_rate = tilt_scale(v) * std::polar(std::pow(v.now.area(), -2.5), -v.turn()) *
                         (q_rate - q * Complex(2.5 * growth, alpha_rate));
  Vector6d rate;
  rate << an_rate * v.now.centre() + v.an_m * rates.centre, an_rate, s_rate.real(), s_rate.imag(),
      alpha_rate;
  return rate;
}

}  // namespace

LawAnswer moments_law(const LawInput& input, const LawOptions& options) {
  if (input.measured.size() < 4) return refused(LawRefusal::FewPoints);
  const View v = view_of(input);
  const PlaneDepth plane = believed_plane(v);
  TaskJacobian L(6, 6);
  for (int k = 0; k < 6; ++k) {
    L.col(k) = column(v, input.measured, image_field(k, plane, v.now.centre()));
  }
  if (!L.allFinite() || !(std::abs(v.aligned) > 0)) return refused(LawRefusal::Singular);
  return solved(L, error_of(v), input, options);
}

}  // namespace kestrel::laws
