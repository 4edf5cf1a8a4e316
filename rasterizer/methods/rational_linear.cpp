// rational-linear: the rational linear rendering algorithm of Heckbert & Moreton 1991, §3.5, in
// double; rational-linear-float, with parameters in float32; and rational-linear-incremental, which
// in float32 steps along the rows by additions, as was done when the paper was written (§3.1: three
// additions and two divisions).
//
// The mathematics (Heckbert & Moreton 1991, §3.2). Parameters r_i that are affine in clip space
// divide into
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
// |δs_i| <= 11 u max|s_i|, plus the contribution of the places (polygon_drawing.h), so quotients
// have
//
//   |δr_i| <= (|δs_i| + |r_i| |δs_{n+1}|) / s_{n+1} + u |r_i|, that is
//
//   |δr_i| <= (|∂r_i/∂u| + |∂r_i/∂v|) δ + 23 u max|r_i| max(1/w) / s_{n+1}.
//
// The second term grows towards the horizon, where s_{n+1} is small against the greatest 1/w.
//
// Error of rational-linear-float, u = 2^-24. Positions and clipping are as above. So that nothing
// overflows, r_i and 1/w are multiplied by powers of two that bring the greatest |r_i| of the
// polygon's vertices to 1…2 and the greatest 1/w to 1/2…1. An underflow then causes an error of at
// most 2^-149 of the greatest 1/w. For r_i this is less than 2^-24 g scale ULP in all, where g =
// max(1/w) / s_{n+1}. Each s_i is rounded at the vertex. Along an edge, and again along a span,
// each weight (a quotient of differences in double), each product and the sum are rounded. All
// weights are positive, and so is 1/w, so the relative error of s_{n+1} does not grow towards the
// horizon. The roundings at the vertex, of products and of sums cost 5 u of N = s_i and 5 u of D =
// s_{n+1}, hence 10 u M, M = max|r_i|. N and D share their weights. If each weight has an error of
// u, a mean of two ends with shares p and 1 − p of s_{n+1} changes by p (1 − p) 2 u |r_a − r_b| <=
// u M; for edge and span that is 2 u M. Together these are 12 u M <= 12 scale ULP. The quotient
// adds half an ULP, and so does multiplying a result below 2^-126 by its power of two. The last
// 1/64 covers products of roundings, and the roundings of double.
//
// Error of rational-linear-incremental. The ends of a span have errors as above, 4 u of the
// greatest |s_i|; the value at its first sample has 3 u more. With S = M max(1/w), the step d =
// (s_right − s_left) / width has an error of 3 u |d|. Over n steps, at most as many as fit between
// the ends, this adds up to 3 u |s_right − s_left|: 6 u S for a numerator and 3 u S / M for 1/w,
// which is positive. Each addition has a rounding error of u S. So
//
//   |δs_i| <= (13 + n) u S,   |δs_{n+1}| <= (10 + n) u S / M,   |δr| <= c (23 + 2 n) u g M
//
// with c = 1/(1 − ε), where ε = (10 + n) u g is the relative error of 1/w. Towards the horizon this
// has no bound, so r is clamped to the range of the polygon's vertices, which makes |δr| <= 2 M. If
// ε > 1/2, 2 M is less than 2 (23 + 2 n) u g M, so c = 2 is valid everywhere.
//
// Measured on random triangles (tests/rasterizer/methods/rational_linear_variants_test.cpp):
// rational-linear-float has errors of 3 scale ULP, with w up to 1.5 as well as up to 2^20. With w
// up to 4, rational-linear-incremental has errors of 19 scale ULP in rows of 64 pixels, and of 3661
// in rows of 8192.
//
// Not done here, besides the limits of polygon_drawing.h: replacing the n divisions per pixel by a
// reciprocal and n products, as Heckbert & Moreton 1991 do, which would cost one more rounding.
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

/// float in place of double; otherwise the counting number type T itself.
template <class T>
using Single = std::conditional_t<std::is_same_v<T, double>, float, T>;

/// The weights of a place between two others, rounded to float32.
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

  /// Returns the value at the place. If a and b are equal, returns exactly that value.
  S mean(S a, S b) const { return a == b || is_point_ ? a : of_a_ * a + of_b_ * b; }

 private:
  bool is_point_;
  S of_a_{};
  S of_b_{};
};

/// The common part of both methods in float32: everything except the spans. Values of type T always
/// fit a Single<T>.
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
  /// Multiplies by a power of two, which does not count as arithmetic.
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
    // Not below the least positive float: with g > 2^149, 1/w would be rounded to 0.
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
  /// Replaces `ends.left` by the values at the first sample, `ends.left_u`, and `ends.right` by the
  /// step.
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
      // The loop's counter does not count as arithmetic.
      ends.left_u = T(static_cast<double>(ends.left_u) + 1);
    }
    std::copy_n(ends.left.begin(), this->count_ + 1, s.begin());
  }
  void values(const Parameters<T>& s, std::span<T> r) const override {
    SingleFormula<T>::values(s, r);
    for (std::size_t i = 0; i < this->count_; ++i) {
      if (!(r[i] > least_[i])) r[i] = least_[i];  // also replaces NaN
      if (r[i] > greatest_[i]) r[i] = greatest_[i];
    }
  }

 private:
  std::array<T, kMaxAttributes> least_{};
  std::array<T, kMaxAttributes> greatest_{};
};

// Derived above. In all three methods, centres that are not covered get the values of
// rational-linear.
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
                                        .source = "Heckbert & Moreton 1991, §3.5",
                                        .fails = "samples within roundings of an edge; triangles "
                                                 "whose plane all but passes through the eye",
                                        .draw = &scan_triangles_by<RationalLinear>,
                                        .promise = &promise,
                                        .operations = &count_scan<RationalLinear>,
                                        .draw_polygon = &scan_polygon_by<RationalLinear>});

const MethodRegistration kFloat({.name = "rational-linear-float",
                                 .source = "Heckbert & Moreton 1991, §3.5, in float32",
                                 .fails = "towards the horizon, where 1/w has lost its digits",
                                 .draw = &scan_triangles_by<RationalLinearFloat>,
                                 .promise = &promise_float,
                                 .operations = &count_scan<RationalLinearFloat>,
                                 .draw_polygon = &scan_polygon_by<RationalLinearFloat>});

const MethodRegistration kIncremental(
    {.name = "rational-linear-incremental",
     .source = "Heckbert & Moreton 1991, §3.1, §3.5, in float32",
     .fails = "at the end of long rows: roundings add up with every step",
     .draw = &scan_triangles_by<RationalLinearIncremental>,
     .promise = &promise_incremental,
     .operations = &count_scan<RationalLinearIncremental>,
     .draw_polygon = &scan_polygon_by<RationalLinearIncremental>});

}  // namespace
}  // namespace rastercheck::rasterizer
