// Judges computed unit normals (cases::Contract::normal_bound). With m = C n the image, L = ‖m‖ and
// P = ‖|C| |n|‖, a component f must satisfy
//
//   |f − m_i / L| <= β P / L + h,   β = normal_bound 2^-53,   h = 4 · 2^-53 + ulp(f) / 2
//
// i.e. (f − h) L − m_i <= β P and m_i − (f + h) L <= β P. m_i, L² and P² are in the ring, where a
// √X + b <= c √Y is decided by squaring twice.

#include "oracle/judged_normals.h"

#include <array>
#include <cmath>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/floating_point.h"
#include "oracle/internal/number.h"

namespace rastercheck::oracle {
namespace {

using records::FragmentClass;

using RingMatrix3 = std::array<std::array<Ring, 3>, 3>;  ///< [row][column]

/// The sign of a √x + b, x >= 0.
int sign_of_root_sum(const Ring& a, const Ring& x, const Ring& b) {
  const int of_root = sign_of(x) == 0 ? 0 : sign_of(a);
  const int of_rest = sign_of(b);
  if (of_root == 0 || of_root == of_rest) return of_rest;
  if (of_rest == 0) return of_root;
  return of_root * sign_of(Ring(a * a * x - b * b));
}

/// True if a √x + b <= c √y; x, y and c must not be negative.
bool is_at_most(const Ring& a, const Ring& x, const Ring& b, const Ring& c, const Ring& y) {
  if (sign_of_root_sum(a, x, b) <= 0) return true;
  const Ring rest = a * a * x + b * b - c * c * y;
  return sign_of_root_sum(Ring(Ring(2) * a * b), x, rest) <= 0;
}

/// The cofactors of the model matrix's upper left 3×3 part, and the sign of its determinant.
struct Cofactors {
  RingMatrix3 c;
  int sign = 0;
};

Cofactors cofactors_of(const cases::Matrix4& model) {
  const auto a = [&model](std::size_t row, std::size_t column) {
    return exact_ring(model[row % 3 * 4 + column % 3]);
  };
  Cofactors found;
  Ring determinant(0);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      // Cyclic indices include the cofactor's sign.
      found.c[row][column] = a(row + 1, column + 1) * a(row + 2, column + 2) -
                             a(row + 1, column + 2) * a(row + 2, column + 1);
    }
  }
  for (std::size_t column = 0; column < 3; ++column)
    determinant += a(0, column) * found.c[0][column];
  found.sign = sign_of(determinant);
  return found;
}

/// The image of a normal, and the squares of its length and of the length of its terms.
struct NormalImage {
  std::array<Ring, 3> m;
  Ring square{0};
  Ring terms_square{0};
};

NormalImage image_of(const Cofactors& cofactors, const cases::Normal& normal) {
  NormalImage image;
  for (std::size_t row = 0; row < 3; ++row) {
    Ring sum(0);
    Ring sizes(0);
    for (std::size_t column = 0; column < 3; ++column) {
      const Ring term = cofactors.c[row][column] * exact_ring(normal[column]);
      sum += term;
      sizes += magnitude(term);
    }
    image.m[row] = cofactors.sign < 0 ? Ring(-sum) : sum;
    image.square += sum * sum;
    image.terms_square += sizes * sizes;
  }
  return image;
}

FragmentClass class_of_component(const NormalImage& image, std::size_t i, const Ring& share,
                                 float f) {
  if (std::isnan(f)) return FragmentClass::not_a_number;
  if (std::isinf(f)) return FragmentClass::infinite;
  if (sign_of(image.square) == 0) {
    return f == 0 ? FragmentClass::correct : FragmentClass::beyond_bound;
  }
  const Ring half_ulp(std::ldexp(1.0, ulp_exponent(f) - 1));
  const Ring margin = Ring(0x1p-51) + half_ulp;
  const Ring value = exact_ring(f);
  const Ring& m = image.m[i];
  const bool is_within =
      is_at_most(Ring(value - margin), image.square, Ring(-m), share, image.terms_square) &&
      is_at_most(Ring(-value - margin), image.square, m, share, image.terms_square);
  return is_within ? FragmentClass::correct : FragmentClass::beyond_bound;
}

/// m_i / ‖m‖; 0 if the image has no direction.
records::Enclosure unit_component(const NormalImage& image, std::size_t i) {
  const int sign = sign_of(image.m[i]);
  if (sign == 0) return {0, 0};
  const records::Enclosure root =
      enclose_sqrt(quotient(Ring(image.m[i] * image.m[i]), image.square));
  return sign > 0 ? root : records::Enclosure{-root.hi, -root.lo};
}

}  // namespace

std::vector<JudgedNormal> judge_normals(const cases::Matrix4& model,
                                        std::span<const cases::Normal> normals,
                                        std::span<const cases::Normal> computed,
                                        float normal_bound) {
  const DefaultFloatingPoint modes;
  const Cofactors cofactors = cofactors_of(model);
  const Ring share = exact_ring(normal_bound) * Ring(0x1p-53);
  std::vector<JudgedNormal> judged(computed.size());
  for (std::size_t k = 0; k < computed.size(); ++k) {
    const NormalImage image = image_of(cofactors, normals[k]);
    JudgedNormal& normal = judged[k];
    normal.has_direction = sign_of(image.square) != 0;
    normal.is_mirrored = cofactors.sign < 0;
    normal.is_singular = cofactors.sign == 0;
    // Compares the squares of 2^-25 L and β P.
    const Ring beyond = share * share * image.terms_square;
    normal.is_cancelled = Ring(0x1p-50) * image.square < beyond;
    for (std::size_t i = 0; i < 3; ++i) {
      normal.components[i].fragment_class = class_of_component(image, i, share, computed[k][i]);
      normal.components[i].exact = unit_component(image, i);
    }
  }
  return judged;
}

}  // namespace rastercheck::oracle
