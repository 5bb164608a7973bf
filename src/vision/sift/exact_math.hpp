#pragma once

#include <array>
#include <cmath>

/// Functions made of additions and multiplications only. The C library's choose an instruction set
/// when the program starts, and their last bit with it.
namespace kestrel::sift {

/// 1 / k!
constexpr std::array<double, 20> kInverseFactorial = [] {
  std::array<double, 20> f{};
  double product = 1;
  for (int k = 0; k < 20; ++k) {
    if (k > 0) product *= k;
    f[std::size_t(k)] = 1 / product;
  }
  return f;
}();

/// e^x within 1e-14 of itself, |x| < 700.
inline double exponential(double x) {
  constexpr double kLn2 = 0.6931471805599453;
  const double n = std::floor(x / kLn2 + 0.5);
  const double r = x - n * kLn2;
  double sum = 0;
  for (std::size_t k = 13; k < 14; --k) sum = sum * r + kInverseFactorial[k];
  return std::ldexp(sum, int(n));
}

/// 2^x.
inline double power_of_two(double x) { return exponential(x * 0.6931471805599453); }

struct Direction {
  double cosine = 1;
  double sine = 0;
};

/// Direction of an angle in [0, 2 pi], rad, within 1e-14.
inline Direction direction(double angle_rad) {
  constexpr double kQuarter = 1.5707963267948966;
  const int quarter = int(std::floor(angle_rad / kQuarter + 0.5));
  const double r = angle_rad - quarter * kQuarter;
  const double s = -r * r;
  double cosine = 0;
  double sine = 0;
  for (std::size_t k = 14; k < 15; k -= 2) {
    cosine = cosine * s + kInverseFactorial[k];
    sine = sine * s + kInverseFactorial[k + 1];
  }
  sine *= r;
  switch (quarter % 4) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace kestrel::sift
