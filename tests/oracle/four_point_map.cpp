#include "tests/oracle/four_point_map.h"

#include "oracle/internal/rational_number.h"

namespace rastercheck::oracle {
namespace {

using Column = Eigen::Matrix<Field, 3, 1>;
using Columns = std::array<Column, 4>;
using Side = FourPointError::Side;

Columns columns_of(const FourPoints& points) {
  Columns columns;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [x, y, t] = points[i];
    columns[i] = Column(to_field(x), to_field(y), to_field(t));
  }
  return columns;
}

Field determinant(const Column& a, const Column& b, const Column& c) { return a.dot(b.cross(c)); }

/// The determinants c_i det(p_0, p_1, p_2), where p_3 = Σ c_i p_i; the last is det(p_0, p_1, p_2).
using Shares = std::array<Field, 4>;

tl::expected<Shares, FourPointError> shares_of(const Columns& p, Side side) {
  Shares shares{determinant(p[3], p[1], p[2]), determinant(p[0], p[3], p[2]),
                determinant(p[0], p[1], p[3]), determinant(p[0], p[1], p[2])};
  // Each determinant is 0 if its three points lie on a line.
  using Three = std::array<std::size_t, 3>;
  constexpr std::array<Three, 4> kPoints{{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
  for (std::size_t i = shares.size(); i-- > 0;) {
    if (sign_of(shares[i]) == 0) return tl::unexpected(FourPointError{side, kPoints[i]});
  }
  return shares;
}

}  // namespace

std::optional<std::array<Rational, 2>> position_of(const PlanePoint& p) {
  const Field& t = to_field(p.t);
  if (sign_of(t) == 0) return std::nullopt;
  return std::array{to_rational(to_field(p.x) / t), to_rational(to_field(p.y) / t)};
}

tl::expected<FourPointMap, FourPointError> FourPointMap::infer(const FourPoints& from,
                                                               const FourPoints& to) {
  const Columns p = columns_of(from);
  const Columns q = columns_of(to);
  const auto alphas = shares_of(p, Side::from);
  if (!alphas) return tl::unexpected(alphas.error());
  const auto betas = shares_of(q, Side::to);
  if (!betas) return tl::unexpected(betas.error());

  // Dividing the factors by the first one, β_0/α_0, makes the matrix map p_0 to exactly q_0.
  const Field first = (*betas)[0] / (*alphas)[0];
  Eigen::Matrix<Field, 3, 3> sum = Eigen::Matrix<Field, 3, 3>::Constant(Field(0));
  for (std::size_t i = 0; i < 3; ++i) {
    const Field factor = (*betas)[i] / (*alphas)[i] / first;
    const Column row = p[(i + 1) % 3].cross(p[(i + 2) % 3]) / (*alphas)[3];
    sum += q[i] * factor * row.transpose();
  }
  FourPointMap map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      map.matrix_[i][j] =
          to_rational(sum(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return map;
}

PlanePoint FourPointMap::at(const PlanePoint& p) const {
  std::array<Rational, 3> image;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [a, b, c] = matrix_[i];
    image[i] = to_rational(to_field(a) * to_field(p.x) + to_field(b) * to_field(p.y) +
                           to_field(c) * to_field(p.t));
  }
  return {image[0], image[1], image[2]};
}

std::optional<std::array<Rational, 2>> FourPointMap::at(double x, double y) const {
  return position_of(at({Rational(x), Rational(y)}));
}

}  // namespace rastercheck::oracle
