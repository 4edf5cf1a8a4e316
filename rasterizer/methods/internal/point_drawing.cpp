#include "rasterizer/methods/internal/point_drawing.h"

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "rasterizer/internal/fragment_drawing.h"
#include "rasterizer/internal/standard_pattern.h"
#include "rasterizer/methods/internal/method_tap.h"
#include "rasterizer/methods/internal/window_map.h"

namespace rastercheck::rasterizer {
namespace {

/// Returns the state for draw_mesh, which draws all attributes except smooth ones. Smooth
/// attributes are declared flat, and their values are overwritten later.
State without_smooth(const State& state) {
  State others = state;
  others.snapping.reset();
  others.precision = Precision::float64;
  for (Qualifier& qualifier : others.attributes) {
    if (qualifier.interpolation == Interpolation::smooth) {
      qualifier.interpolation = Interpolation::flat;
    }
  }
  return others;
}

/// Puts smooth values into the fragments of a draw, triangle by triangle.
class PointDrawing {
 public:
  PointDrawing(const State& state, const Mesh& mesh, const TargetSize& size, PointFormula& formula,
               Fragments& fragments, MethodTap* tap)
      : mesh_(mesh),
        formula_(formula),
        fragments_(fragments),
        tap_(tap),
        pattern_(standard_pattern(size.samples)),
        attribute_count_(state.attributes.size()),
        window_map_(state) {
    for (std::size_t i = 0; i < attribute_count_; ++i) {
      if (state.attributes[i].interpolation != Interpolation::smooth) continue;
      smooth_[smooth_count_++] = {i, state.attributes[i].location};
    }
  }

  /// Fills in the fragments from `begin` on.
  void fill(std::size_t begin) {
    if (smooth_count_ == 0) return;
    while (begin < fragments_.size()) {
      const std::size_t end = end_of_pixel(begin);
      if (!is_set_ || triangle_ != fragments_.triangle[begin]) set(fragments_.triangle[begin]);
      fill_pixel(begin, end);
      begin = end;
    }
  }

 private:
  struct Smooth {
    std::size_t attribute = 0;
    Location location = Location::sample;
    /// True if all three values are the same zero, which is copied because sums may change its
    /// sign.
    bool is_zero = false;
  };

  std::size_t end_of_pixel(std::size_t begin) const {
    std::size_t end = begin + 1;
    while (end < fragments_.size() && fragments_.triangle[end] == fragments_.triangle[begin] &&
           fragments_.y[end] == fragments_.y[begin] && fragments_.x[end] == fragments_.x[begin]) {
      ++end;
    }
    return end;
  }

  float value_of(std::uint32_t vertex, std::size_t attribute) const {
    return mesh_.attributes[vertex * attribute_count_ + attribute];
  }

  void set(std::uint32_t triangle) {
    triangle_ = triangle;
    is_set_ = true;
    const glm::uvec3& corners = mesh_.triangles[triangle];
    const std::array<std::uint32_t, 3> indices{corners.x, corners.y, corners.z};
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec4& p = mesh_.positions[indices[i]];
      PointVertex& vertex = vertices_[i];
      vertex.index = indices[i];
      const Numerators at = window_map_(p.x, p.y, p.w);
      vertex.x = at.x;
      vertex.y = at.y;
      vertex.w = p.w;
      for (std::size_t k = 0; k < smooth_count_; ++k) {
        vertex.values[k] = value_of(indices[i], smooth_[k].attribute);
      }
    }
    for (std::size_t k = 0; k < smooth_count_; ++k) {
      const float first = value_of(indices[0], smooth_[k].attribute);
      smooth_[k].is_zero = first == 0;
      for (const std::uint32_t vertex : indices) {
        const float value = value_of(vertex, smooth_[k].attribute);
        if (value != 0 || std::signbit(value) != std::signbit(first)) smooth_[k].is_zero = false;
      }
    }
    formula_.set(vertices_, smooth_count_);
    const bool is_traced = tap_ != nullptr && tap_->address().triangle == triangle_;
    if (is_traced && tap_->trace) show_vertices();
  }

  void show_vertices() const {
    auto& corners = tap_->trace->corners.emplace();
    const glm::uvec3& triangle = mesh_.triangles[triangle_];
    for (std::size_t i = 0; i < 3; ++i) {
      const PointVertex& vertex = vertices_[i];
      const double z = mesh_.positions[triangle[static_cast<int>(i)]].z;
      corners[i] = {vertex.x, vertex.y, z, vertex.w, true, {}};
      corners[i].share[i] = 1;
    }
  }

  /// Fills in the fragments of one triangle in one pixel.
  void fill_pixel(std::size_t begin, std::size_t end) {
    const double x = fragments_.x[begin];
    const double y = fragments_.y[begin];
    const auto evaluate = [&](const SampleOffset& offset, Location location, std::size_t from,
                              std::size_t to) {
      if (!has(location)) return;
      std::array<double, kMaxAttributes> values;
      formula_.at(x + offset.x, y + offset.y, std::span(values.data(), smooth_count_));
      for (std::size_t k = 0; k < smooth_count_; ++k) {
        if (smooth_[k].location != location) continue;
        const bool is_copied = smooth_[k].is_zero || std::isnan(values[k]);
        const double evaluated = is_copied ? vertices_[0].values[k] : values[k];
        const auto value = static_cast<float>(evaluated);
        for (std::size_t i = from; i < to; ++i) {
          fragments_.attributes[i * attribute_count_ + smooth_[k].attribute] = value;
          if (tap_ == nullptr) continue;
          show(i, smooth_[k].attribute,
               {.u = x + offset.x, .v = y + offset.y, .evaluated = evaluated, .value = value});
        }
      }
    };
    for (std::size_t i = begin; i < end; ++i) {
      evaluate(pattern_[fragments_.sample[i]], Location::sample, i, i + 1);
    }
    evaluate(kPixelCenter, Location::center, begin, end);
    const bool is_whole = end - begin == pattern_.size();
    evaluate(is_whole ? kPixelCenter : pattern_[fragments_.sample[begin]], Location::centroid,
             begin, end);
  }

  void show(std::size_t fragment, std::size_t attribute, const TracedValue& value) const {
    if (tap_->trace && tap_->is_at(triangle_, fragments_.x[fragment], fragments_.y[fragment],
                                   fragments_.sample[fragment])) {
      tap_->trace->attributes[attribute] = value;
    }
  }

  bool has(Location location) const {
    for (std::size_t k = 0; k < smooth_count_; ++k) {
      if (smooth_[k].location == location) return true;
    }
    return false;
  }

  const Mesh& mesh_;
  PointFormula& formula_;
  Fragments& fragments_;
  MethodTap* tap_;  ///< or nullptr
  std::span<const SampleOffset> pattern_;
  std::size_t attribute_count_;
  WindowMap window_map_;
  std::array<Smooth, kMaxAttributes> smooth_;
  std::size_t smooth_count_ = 0;
  bool is_set_ = false;
  std::uint32_t triangle_ = 0;
  std::array<PointVertex, 3> vertices_;
};

}  // namespace

DrawCounts draw_points(const State& state, const Mesh& mesh, const TargetSize& size,
                       PointFormula& formula, Fragments& fragments, MethodTap* tap) {
  const std::size_t begin = fragments.size();
  const State others = without_smooth(state);
  const DrawCounts counts = draw_mesh(others, mesh, size, fragments);
  if (tap != nullptr) tap->trace = trace_mesh(others, mesh, size, tap->address());
  PointDrawing(state, mesh, size, formula, fragments, tap).fill(begin);
  return counts;
}

std::array<PointVertex, 3> counted_triangle() {
  std::array<PointVertex, 3> vertices;
  vertices[0] = {.x = 0, .y = 0, .w = 1, .values = {0.125, 0.25}};
  vertices[1] = {.x = 16, .y = 0, .w = 2, .values = {0.875, 0.375}};
  vertices[2] = {.x = 0, .y = 32, .w = 4, .values = {0.5, 0.75}};
  return vertices;
}

}  // namespace rastercheck::rasterizer
