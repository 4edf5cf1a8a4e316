// object-projective: parameters that are projective, not affine, in object space (Heckbert &
// Moreton 1991, §3.4).
//
// The mathematics. If w_r varies,
//
//   (u w_r/w, v w_r/w, w_r/w)
//
// is affine in window space. The method interpolates these three, and divides the first two by the
// last to get u and v. Parameters that are affine to each other form a cluster, and each cluster
// has its own w_r/w. With w_r = 1 this is rational-linear's formula. The weight E_i = A_i u + B_i v
// + C_i of vertex i (RULES §1) is |det M| times a function that is 1/w_i at vertex i and 0 at the
// other two. So
//
//   u = Σ u_i w_r,i E_i / Σ w_r,i E_i,
//
// where |det M| cancels. Nothing is divided by w_i, so vertices with w <= 0 are allowed. Numerator
// and denominator are planes, set up once per triangle and evaluated at each place:
//
//   (a, b, c) = Σ r_i w_r,i (A_i, B_i, C_i)   and   Σ w_r,i (A_i, B_i, C_i).
//
// Poles. Where Σ w_r,i E_i = 0 the parameters are infinite. If w_r has one sign on a triangle, no
// such place lies inside it. A triangle with w_r of both signs or with w_r = 0 is refused. With a
// slide projector, such a triangle reaches behind the projector and should be clipped there, like
// one that reaches behind the eye. Extrapolated centres may still lie beyond a pole; their values
// are meaningless.
//
// Roundings (internal/point_drawing.h), u = 2^-53: A_i, B_i, C_i have errors of 8 u times their
// terms' magnitudes. Σ w_r,i (A_i, B_i, C_i) adds a product and two sums, which makes 11 u, and the
// evaluation adds 3 u: d = 14. The numerator has one more product, r_i w_r,i: n = 15. Here
//
//   K = Σ |w_r,i| |E|_i / |Σ w_r,i E_i|,
//
// which is the contract's K if w_r = 1. If w_r itself has a relative error of ε u, ε is added to
// both n and d. For quads ε is 6, apart from a factor that all corners share (quad.h).
//
// w_r is not computed here; the caller supplies it (object_projective.h lists its sources).
//
// Operations for two attributes, and the divisions among them:
//   object-projective: 14 (2) per pixel, 2 per vertex, 72 per polygon

#include "rasterizer/methods/object_projective.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "rasterizer/internal/checked_draw.h"
#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

constexpr double kLeastW = 0x1p-64;
constexpr double kMostW = 0x1p64;

/// The planes of values that are grouped in clusters; by default one cluster with w_r = 1.
template <class T>
class ProjectivePlanes {
 public:
  /// Must be called before vertices are set; applies to all triangles.
  void set_clusters(std::size_t count, std::span<const std::size_t> cluster_of_value) {
    cluster_count_ = count;
    for (std::size_t k = 0; k < cluster_of_value.size(); ++k) cluster_of_[k] = cluster_of_value[k];
  }
  /// Must be called before vertex i is set.
  void set_w_r(std::size_t i, std::size_t cluster, T w_r) { w_r_[i][cluster] = w_r; }

  void set_vertex(std::size_t i, const PointVertex& vertex, std::size_t count) {
    x_[i] = T(vertex.x);
    y_[i] = T(vertex.y);
    w_[i] = T(vertex.w);
    for (std::size_t k = 0; k < count; ++k) {
      products_[i][k] = T(vertex.values[k]) * w_r_[i][cluster_of_[k]];
    }
  }

  void set_up(std::size_t count) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      rows_[i] = {y_[j] * w_[k] - y_[k] * w_[j], w_[j] * x_[k] - w_[k] * x_[j],
                  x_[j] * y_[k] - x_[k] * y_[j]};
    }
    for (std::size_t k = 0; k < count; ++k) {
      numerators_[k] = plane(products_[0][k], products_[1][k], products_[2][k]);
    }
    for (std::size_t c = 0; c < cluster_count_; ++c) {
      denominators_[c] = plane(w_r_[0][c], w_r_[1][c], w_r_[2][c]);
    }
  }

  void at(T u, T v, std::span<T> values) const {
    std::array<T, kMaxAttributes + 1> denominators;
    for (std::size_t c = 0; c < cluster_count_; ++c) denominators[c] = denominators_[c].at(u, v);
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = numerators_[k].at(u, v) / denominators[cluster_of_[k]];
    }
  }

 private:
  struct Plane {
    T a;
    T b;
    T c;
    T at(T u, T v) const { return a * u + b * v + c; }
  };

  Plane plane(T s0, T s1, T s2) const {
    const auto& [p, q, r] = rows_;
    return {s0 * p.a + s1 * q.a + s2 * r.a, s0 * p.b + s1 * q.b + s2 * r.b,
            s0 * p.c + s1 * q.c + s2 * r.c};
  }

  /// One number per cluster. The array is one longer than the number of values, because the values
  /// in no cluster share an extra cluster.
  using PerCluster = std::array<T, kMaxAttributes + 1>;
  static PerCluster ones() {
    PerCluster all;
    all.fill(T(1));
    return all;
  }

  std::size_t cluster_count_ = 1;
  std::array<std::size_t, kMaxAttributes> cluster_of_{};
  std::array<PerCluster, 3> w_r_{ones(), ones(), ones()};
  std::array<T, 3> x_;
  std::array<T, 3> y_;
  std::array<T, 3> w_;
  std::array<std::array<T, kMaxAttributes>, 3> products_;
  std::array<Plane, 3> rows_;
  std::array<Plane, kMaxAttributes> numerators_;
  std::array<Plane, kMaxAttributes + 1> denominators_;
};

/// The formula with the checked clusters of a draw. Cluster 0 holds the values in no cluster.
class ClusterFormula : public PointFormula {
 public:
  ClusterFormula(const State& state, std::span<const ParameterCluster> clusters)
      : clusters_(clusters) {
    std::array<std::size_t, kMaxAttributes> cluster_of_attribute{};
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      for (const std::size_t attribute : clusters[c].attributes) {
        cluster_of_attribute[attribute] = c + 1;
      }
    }
    std::array<std::size_t, kMaxAttributes> cluster_of_value{};
    std::size_t values = 0;
    for (std::size_t k = 0; k < state.attributes.size(); ++k) {
      if (state.attributes[k].interpolation != Interpolation::smooth) continue;
      cluster_of_value[values++] = cluster_of_attribute[k];
    }
    planes_.set_clusters(clusters.size() + 1, std::span(cluster_of_value.data(), values));
  }

  void set(const std::array<PointVertex, 3>& vertices, std::size_t count) override {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t c = 0; c < clusters_.size(); ++c) {
        planes_.set_w_r(i, c + 1, clusters_[c].w_r[vertices[i].index]);
      }
      planes_.set_vertex(i, vertices[i], count);
    }
    planes_.set_up(count);
  }
  void at(double u, double v, std::span<double> values) const override { planes_.at(u, v, values); }

 private:
  std::span<const ParameterCluster> clusters_;
  ProjectivePlanes<double> planes_;
};

/// Returns the error in the w_r of one triangle, if any.
std::optional<ClusterError> check_triangle(std::span<const double> w_r, const glm::uvec3& corners) {
  const std::array<double, 3> all{w_r[corners.x], w_r[corners.y], w_r[corners.z]};
  for (const double w : all) {
    if (w == 0) return ClusterError::w_r_zero;
    const bool in_range = std::abs(w) >= kLeastW && std::abs(w) <= kMostW;
    if (!in_range) return ClusterError::w_r_range;
    if ((w > 0) != (all[0] > 0)) return ClusterError::w_r_two_signs;
  }
  return std::nullopt;
}

/// `state` and `mesh` must have been checked.
std::optional<ClusterError> check_clusters(const State& state, const Mesh& mesh,
                                           std::span<const ParameterCluster> clusters) {
  std::array<bool, kMaxAttributes> is_taken{};
  for (const ParameterCluster& cluster : clusters) {
    for (const std::size_t attribute : cluster.attributes) {
      if (attribute >= state.attributes.size() || is_taken[attribute] ||
          state.attributes[attribute].interpolation != Interpolation::smooth) {
        return ClusterError::attribute;
      }
      is_taken[attribute] = true;
    }
    if (cluster.attributes.empty()) return ClusterError::attribute;
    if (cluster.w_r.size() != mesh.positions.size()) return ClusterError::w_r_count;
    for (const glm::uvec3& corners : mesh.triangles) {
      const auto error = check_triangle(cluster.w_r, corners);
      if (error) return error;
    }
  }
  return std::nullopt;
}

Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return {.smooth = point_bound(15, 14, kDoubleRoundoff)};
}

const MethodRegistration kRegistration(
    {.name = "object-projective",
     .source = "Heckbert & Moreton 1991, §3.4",
     .fails = "where the weights cancel; a w_r of both signs in a triangle is refused",
     .draw = &draw_by_formula<ProjectivePlanes, double>,
     .promise = &promise,
     .operations = &count_formula<ProjectivePlanes>});

}  // namespace

std::string_view to_string(ClusterError error) {
  switch (error) {
    case ClusterError::attribute:
      return "a cluster has an attribute that is not the state's, not smooth or in another "
             "cluster, or it has none";
    case ClusterError::w_r_count:
      return "the number of w_r differs from the number of vertices";
    case ClusterError::w_r_zero:
      return "a w_r is 0: the vertex has its parameters at infinity";
    case ClusterError::w_r_range:
      return "a w_r is not finite, or not from 2^-64 to 2^64 in magnitude";
    case ClusterError::w_r_two_signs:
      return "a triangle has w_r of both signs: its parameters have a pole inside";
  }
  return "";
}

ClusterDrawResult draw_object_projective(const State& state, const Mesh& mesh,
                                         std::span<const ParameterCluster> clusters,
                                         const TargetSize& size, Fragments& fragments) {
  if (const auto error = check_draw(state, mesh, size)) return {error, std::nullopt, {}};
  if (const auto error = check_clusters(state, mesh, clusters)) return {std::nullopt, error, {}};
  ClusterFormula formula(state, clusters);
  const auto draw = [&](const State& s, const Mesh& m, const TargetSize& t, Fragments& f) {
    return draw_points(s, m, t, formula, f, nullptr);
  };
  const DrawResult drawn = draw_checked(draw, state, mesh, size, fragments);
  return {drawn.error, std::nullopt, drawn.counts};
}

}  // namespace rastercheck::rasterizer
