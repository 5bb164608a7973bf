#include "outline_motion.hpp"

namespace kestrel::laws {
namespace {

/// c + x X + y Y.
struct Linear {
  double c = 0, x = 0, y = 0;
};

Quadratic operator*(const Linear& p, const Linear& q) {
  return {p.c * q.c, p.c * q.x + p.x * q.c, p.c * q.y + p.y * q.c,
          p.x * q.x, p.x * q.y + p.y * q.x, p.y * q.y};
}

Quadratic operator+(Quadratic a, double constant) {
  a[0] += constant;
  return a;
}

Quadratic operator-(Quadratic a) {
  for (double& c : a) c = -c;
  return a;
}

double value(const Quadratic& f, double X, double Y) {
  return f[0] + f[1] * X + f[2] * Y + f[3] * X * X + f[4] * X * Y + f[5] * Y * Y;
}

/// int X^p Y^q f over the outline.
double integral(const Outline& o, int p, int q, const Quadratic& f) {
  return f[0] * o.mu(p, q) + f[1] * o.mu(p + 1, q) + f[2] * o.mu(p, q + 1) + f[3] * o.mu(p + 2, q) +
         f[4] * o.mu(p + 1, q + 1) + f[5] * o.mu(p, q + 2);
}

/// int X^p Y^q f for an f of first degree: one order less is needed.
double integral(const Outline& o, int p, int q, const Linear& f) {
  return f.c * o.mu(p, q) + f.x * o.mu(p + 1, q) + f.y * o.mu(p, q + 1);
}

Linear divergence(const ImageField& field) {
  return {field.x[1] + field.y[2], 2 * field.x[3] + field.y[4], field.x[4] + 2 * field.y[5]};
}

/// d/dt int X^p Y^q.
double moment_rate(const Outline& o, const ImageField& field, int p, int q) {
  double rate = integral(o, p, q, divergence(field));
  if (p > 0) rate += p * integral(o, p - 1, q, field.x);
  if (q > 0) rate += q * integral(o, p, q - 1, field.y);
  return rate;
}

}  // namespace

Eigen::Vector2d ImageField::at(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d d = p - centre;
  return {value(x, d.x(), d.y()), value(y, d.x(), d.y())};
}

ImageField image_field(int axis, const PlaneDepth& plane, const Eigen::Vector2d& centre) {
  const Linear one{1, 0, 0};
  const Linear x{centre.x(), 1, 0};
  const Linear y{centre.y(), 0, 1};
  const Linear w{plane.inverse_depth_at(centre), plane.A, plane.B};
  switch (axis) {
    case 0:
      return {centre, -(one * w), {}};
    case 1:
      return {centre, {}, -(one * w)};
    case 2:
      return {centre, x * w, y * w};
    case 3:
      return {centre, x * y, y * y + 1};
    case 4:
      return {centre, -(x * x + 1), -(x * y)};
    default:
      return {centre, one * y, -(one * x)};
  }
}

OutlineRates outline_rates(const Outline& outline, const ImageField& field) {
  OutlineRates rates;
  rates.area = moment_rate(outline, field, 0, 0);
  rates.centre << moment_rate(outline, field, 1, 0), moment_rate(outline, field, 0, 1);
  rates.centre /= outline.area();
  ImageField about = field;  // as seen from the centre that moves along
  about.x[0] -= rates.centre.x();
  about.y[0] -= rates.centre.y();
  rates.mu30 = moment_rate(outline, about, 3, 0);
  rates.mu21 = moment_rate(outline, about, 2, 1);
  rates.mu12 = moment_rate(outline, about, 1, 2);
  rates.mu03 = moment_rate(outline, about, 0, 3);
  return rates;
}

}  // namespace kestrel::laws
