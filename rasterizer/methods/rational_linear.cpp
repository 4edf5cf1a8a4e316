// rational-linear: the rational linear rendering algorithm of Heckbert and Moreton, Interpolation
// for Polygon Texture Mapping and Shading, §3.5 (seed 002), in double; rational-linear-float, its
// parameters in float32; and rational-linear-incremental, which in float32 steps along the rows by
// additions, as was done when the text was written (§3.1: three additions and two divisions).
//
// The mathematics (seed 002 §3.2). Parameters r_i that are affine in clip space divide into
//
//   s_i = r_i / w,   s_{n+1} = 1 / w,
//
// which are affine in window space. So: clip the triangle, with r_i linear in clip space; at each
// vertex divide by w; interpolate s_i linearly along the edges and along the rows; at each sample
// divide:
//
//   r_i = s_i / s_{n+1}.
//
// Steps 1 to 3 and the scan conversion are those of internal/polygon_drawing.h.
//
// Error of rational-linear, first order, u = 2^-53 (rounding to float32, once, comes on top).
// |δs_i| <= 11 u max|s_i|
// and what the places contribute (polygon_drawing.h), so of the quotients
//
//   |δr_i| <= (|δs_i| + |r_i| |δs_{n+1}|) / s_{n+1} + u |r_i|, that is
//
//   |δr_i| <= (|∂r_i/∂u| + |∂r_i/∂v|) δ + 23 u max|r_i| max(1/w) / s_{n+1}.
//
// The second term grows towards the horizon, where s_{n+1} is small against the greatest 1/w.
//
// Error of rational-linear-float, u = 2^-24. Positions and clipping are as above. So that nothing
// overflows, r_i and 1/w are multiplied with powers of two that make the greatest |r_i| and the
// greatest 1/w of the polygon's vertices 1 to 2. What underflows then is off by 2^-150 of the
// greatest 1/w, less than 2^-24 g scale ULP of r_i in all, g = max(1/w) / s_{n+1}. Each s_i has a
// rounding at the vertex, and along an edge and along a span a rounding of each weight, which is a
// quotient of differences in double, of each product, and of the sum. All weights are positive, and
// so is 1/w: what is off of s_{n+1} is off relative to itself, and nothing grows towards the
// horizon. Vertex, products and sums: 5 u of N and 5 u of D, hence 10 u M, M = max|r_i|. Weights: a
// mean of two ends with shares p and 1 − p of s_{n+1} changes by p (1 − p) 2 u |r_a − r_b| <= u M
// if each weight is off by u, and N and D have the same weights: 2 u M. Together 12 u M <= 12 scale
// ULP; the quotient adds a half, the power of two of a result below 2^-126 another. 1/64 is for
// products of roundings, and for those of double.
//
// Error of rational-linear-incremental. A span has ends as above, 4 u of the greatest |s_i|, and
// begins with 3 u more, at its first sample. With S = M max(1/w), the step d = (s_right − s_left) /
// width is off by 3 u |d|, of which n steps, no more than fit between the ends, make 3 u
// |s_right − s_left|: 6 u S of a numerator and 3 u S / M of 1/w, which is positive. Each addition
// rounds to u S. So
//
//   |δs_i| <= (13 + n) u S,   |δs_{n+1}| <= (10 + n) u S / M,   |δr| <= c (23 + 2 n) u g M
//
// with c = 1/(1 − ε), ε = (10 + n) u g what 1/w may be off relative to itself. Towards the horizon
// that has no bound, so r is held to the range of the polygon's vertices, and |δr| <= 2 M there:
// with ε > 1/2 that is less than 2 (23 + 2 n) u g M, so that c = 2 serves everywhere.
//
// Measured on random triangles (tests/rasterizer/methods/rational_linear_variants_test.cpp):
// float32 is off by 3 scale ULP, whether w goes to 1.5 or to 2^20; increments, w up to 4, by 19 in
// rows of 64 pixels and by 3661 in rows of 8192.
//
// What they do not do, besides what polygon_drawing.h does not: seed 002's reciprocal and products
// in place of the n divisions per pixel. They cost a rounding more.
//
// Operations for two attributes, and the divisions among them:
//   rational-linear: 17 (5) per pixel, 30 (6) per row, 3 (3) per vertex
//   rational-linear-float: 16 (4) per pixel, 28 (4) per row, 3 (3) per vertex
//   rational-linear-incremental: 5 (2) per pixel, 49 (9) per row, 3 (3) per vertex

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include "rasterizer/methods/internal/polygon_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

template <class T>
class RationalLinear : public LinearFormula<T> {
 public:
  void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const override {
    for (std::size_t i = 0; i < this->count_; ++i) s[i] = vertex.r[i] / vertex.w;
    s[this->count_] = T(1) / vertex.w;
  }
  void values(const Parameters<T>& s, std::span<T> r) const override {
    for (std::size_t i = 0; i < this->count_; ++i) r[i] = s[i] / s[this->count_];
  }

 protected:
  std::size_t parameter_count() const override { return this->count_ + 1; }
};

/// Numbers of float32, or numbers that count.
template <class T>
using Single = std::conditional_t<std::is_same_v<T, double>, float, T>;

/// A place between two others, its weights rounded to float32.
template <class T>
class SingleWeights {
 public:
  using S = Single<T>;

  explicit SingleWeights(const Place<T>& place) {
    const T length = place.x_b - place.x_a;
    is_point_ = length == T(0);
    if (is_point_) return;
    of_a_ = S((place.x_b - place.x) / length);
    of_b_ = S((place.x - place.x_a) / length);
  }

  /// Equal ends give exactly their value.
  S mean(S a, S b) const { return a == b || is_point_ ? a : of_a_ * a + of_b_ * b; }

 private:
  bool is_point_;
  S of_a_{};
  S of_b_{};
};

/// What both methods in float32 have in common: all but the spans. Of a T only what fits a
/// Single<T> is used.
template <class T>
class SingleFormula : public ScanFormula<T> {
 public:
  void set_polygon(std::span<const ScanVertex<T>> vertices, std::size_t count) override {
    this->count_ = count;
    double least_w = std::numeric_limits<double>::infinity();
    for (const ScanVertex<T>& vertex : vertices) {
      least_w = std::min(least_w, static_cast<double>(vertex.w));
    }
    w_exponent_ = std::ilogb(least_w);
    for (std::size_t i = 0; i < count; ++i) {
      double greatest = 0;
      for (const ScanVertex<T>& vertex : vertices) {
        greatest = std::max(greatest, std::abs(static_cast<double>(vertex.r[i])));
      }
      exponents_[i] = greatest > 0 ? std::ilogb(greatest) : 0;
    }
  }
  void set_vertex(const ScanVertex<T>& vertex, Parameters<T>& s) const override {
    for (std::size_t i = 0; i < this->count_; ++i) {
      s[i] = T(S(scaled(vertex.r[i] / vertex.w, w_exponent_ - exponents_[i])));
    }
    s[this->count_] = T(S(scaled(T(1) / vertex.w, w_exponent_)));
  }
  void along_edge(const Place<T>& place, const Parameters<T>& a, const Parameters<T>& b,
                  Parameters<T>& s) const override {
    const SingleWeights<T> weights(place);
    for (std::size_t i = 0; i <= this->count_; ++i) s[i] = T(weights.mean(S(a[i]), S(b[i])));
  }
  void values(const Parameters<T>& s, std::span<T> r) const override {
    for (std::size_t i = 0; i < this->count_; ++i) {
      r[i] = scaled(T(S(s[i]) / S(s[this->count_])), exponents_[i]);
    }
  }

 protected:
  using S = Single<T>;

 private:
  /// Times a power of two, which is no arithmetic to count.
  static T scaled(T value, int exponent) {
    return T(std::ldexp(static_cast<double>(value), exponent));
  }

  int w_exponent_ = 0;
  std::array<int, kMaxAttributes> exponents_{};
};

template <class T>
class RationalLinearFloat : public SingleFormula<T> {
 public:
  using typename SingleFormula<T>::S;

  void along_span(SpanEnds<T>& ends, T u, Parameters<T>& s) const override {
    const SingleWeights<T> weights({u, ends.left_u, ends.right_u});
    for (std::size_t i = 0; i < this->count_; ++i) {
      s[i] = T(weights.mean(S(ends.left[i]), S(ends.right[i])));
    }
    // Not 0, which g > 2^149 would make it.
    const auto reciprocal_w = weights.mean(S(ends.left[this->count_]), S(ends.right[this->count_]));
    const S least(std::numeric_limits<float>::denorm_min());
    s[this->count_] = T(reciprocal_w < least ? least : reciprocal_w);
  }
};

template <class T>
class RationalLinearIncremental : public SingleFormula<T> {
 public:
  using typename SingleFormula<T>::S;

  void set_polygon(std::span<const ScanVertex<T>> vertices, std::size_t count) override {
    SingleFormula<T>::set_polygon(vertices, count);
    for (std::size_t i = 0; i < count; ++i) {
      least_[i] = greatest_[i] = vertices[0].r[i];
      for (const ScanVertex<T>& vertex : vertices) {
        if (vertex.r[i] < least_[i]) least_[i] = vertex.r[i];
        if (vertex.r[i] > greatest_[i]) greatest_[i] = vertex.r[i];
      }
    }
  }
  /// `ends.left` becomes what is at `ends.left_u`, the first sample, `ends.right` the step.
  void set_span(SpanEnds<T>& ends, T first) const override {
    const SingleWeights<T> weights({first, ends.left_u, ends.right_u});
    const auto width = static_cast<S>(ends.right_u - ends.left_u);
    for (std::size_t i = 0; i <= this->count_; ++i) {
      const auto left = static_cast<S>(ends.left[i]);
      const auto right = static_cast<S>(ends.right[i]);
      ends.left[i] = T(weights.mean(left, right));
      ends.right[i] = T((right - left) / width);
    }
    ends.left_u = first;
  }
  void along_span(SpanEnds<T>& ends, T u, Parameters<T>& s) const override {
    while (ends.left_u < u) {
      for (std::size_t i = 0; i <= this->count_; ++i) {
        ends.left[i] = T(S(ends.left[i]) + S(ends.right[i]));
      }
      // The loop's counter, no arithmetic to count.
      ends.left_u = T(static_cast<double>(ends.left_u) + 1);
    }
    std::copy_n(ends.left.begin(), this->count_ + 1, s.begin());
  }
  void values(const Parameters<T>& s, std::span<T> r) const override {
    SingleFormula<T>::values(s, r);
    for (std::size_t i = 0; i < this->count_; ++i) {
      if (!(r[i] > least_[i])) r[i] = least_[i];  // or no number
      if (r[i] > greatest_[i]) r[i] = greatest_[i];
    }
  }

 private:
  std::array<T, kMaxAttributes> least_{};
  std::array<T, kMaxAttributes> greatest_{};
};

// The derivations above. Centres that are not covered are what rational-linear makes them, in all
// three.
constexpr double kPerHorizon = kScannedPerspectiveBound.per_horizon;

Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return scanned_promise(Claim::perspective, kScannedPerspectiveBound);
}

Promise promise_float(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return scanned_promise(Claim::perspective,
                         {.constant = 13 + 0x1p-6, .per_horizon = 2 * kPerHorizon});
}

Promise promise_incremental(const State& state, const Mesh& /*mesh*/, const TargetSize& size) {
  const double columns = std::min(static_cast<double>(size.width),
                                  std::ceil(std::abs(double{state.viewport.size.x})) + 1);
  const double steps = columns - 1;
  return scanned_promise(Claim::perspective,
                         {.constant = 1, .per_horizon = 2 * (23 + 2 * steps) + kPerHorizon});
}

const MethodRegistration kRegistration({.name = "rational-linear",
                                        .source = "seed 002 §3.5 (Heckbert and Moreton, 1991)",
                                        .fails = "samples within roundings of an edge; triangles "
                                                 "whose plane all but passes through the eye",
                                        .draw = &scan_triangles_by<RationalLinear>,
                                        .promise = &promise,
                                        .operations = &count_scan<RationalLinear>,
                                        .draw_polygon = &scan_polygon_by<RationalLinear>});

const MethodRegistration kFloat({.name = "rational-linear-float",
                                 .source = "seed 002 §3.5, in float32",
                                 .fails = "towards the horizon, where 1/w has lost its digits",
                                 .draw = &scan_triangles_by<RationalLinearFloat>,
                                 .promise = &promise_float,
                                 .operations = &count_scan<RationalLinearFloat>,
                                 .draw_polygon = &scan_polygon_by<RationalLinearFloat>});

const MethodRegistration kIncremental(
    {.name = "rational-linear-incremental",
     .source = "seed 002 §3.1, §3.5, in float32",
     .fails = "at the end of long rows: roundings add up with every step",
     .draw = &scan_triangles_by<RationalLinearIncremental>,
     .promise = &promise_incremental,
     .operations = &count_scan<RationalLinearIncremental>,
     .draw_polygon = &scan_polygon_by<RationalLinearIncremental>});

}  // namespace
}  // namespace rastercheck::rasterizer
