#include "rasterizer/methods/polygon.h"

#include <algorithm>
#include <cmath>

#include "rasterizer/internal/checked_draw.h"
#include "rasterizer/internal/determinant.h"
#include "rasterizer/methods/internal/clip_polygon.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

// Near, far, each clip distance, and each of the guard band's four sides add at most one vertex.
static_assert(kMaxPolygonCorners + 2 + kMaxClipDistances + 4 <= ClipPolygon::kCapacity);

bool are_finite(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(),
                     [](float value) { return std::isfinite(value); });
}

std::optional<PolygonFault> check_corner(const State& state, const PolygonVertex& corner,
                                         std::size_t index) {
  if (corner.attributes.size() != state.attributes.size()) {
    return PolygonFault{PolygonError::attribute_values, index};
  }
  if (corner.clip_distances.size() != state.clip_distance_count) {
    return PolygonFault{PolygonError::clip_distance_values, index};
  }
  const glm::vec4& p = corner.position;
  const float position[] = {p.x, p.y, p.z, p.w};
  if (!are_finite(position) || !are_finite(corner.attributes) ||
      !are_finite(corner.clip_distances)) {
    return PolygonFault{PolygonError::not_finite, index};
  }
  return std::nullopt;
}

std::optional<PolygonFault> check_shape(std::span<const PolygonVertex> polygon) {
  int orientation = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    for (std::size_t j = 1; j < k; ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const int turn =
            determinant_sign(polygon[i].position, polygon[j].position, polygon[k].position);
        if (turn == -orientation && turn != 0) return PolygonFault{PolygonError::not_convex, k};
        if (orientation == 0) orientation = turn;
      }
    }
  }
  if (orientation == 0) return PolygonFault{PolygonError::degenerate};
  return std::nullopt;
}

std::optional<PolygonFault> check_polygon(const State& state,
                                          std::span<const PolygonVertex> polygon) {
  if (polygon.size() < 3 || polygon.size() > kMaxPolygonCorners) {
    return PolygonFault{PolygonError::corner_count};
  }
  for (std::size_t i = 0; i < state.attributes.size(); ++i) {
    const Qualifier& qualifier = state.attributes[i];
    if (qualifier.interpolation != Interpolation::flat && qualifier.location != Location::sample) {
      return PolygonFault{PolygonError::location, i};
    }
  }
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (const auto fault = check_corner(state, polygon[i], i)) return fault;
  }
  return check_shape(polygon);
}

}  // namespace

std::string_view to_string(PolygonError error) {
  switch (error) {
    case PolygonError::draw:
      return "the draw was refused";
    case PolygonError::no_polygons:
      return "the method draws triangles only";
    case PolygonError::corner_count:
      return "a polygon has 3 to 16 corners";
    case PolygonError::attribute_values:
      return "a corner does not have one value for each attribute";
    case PolygonError::clip_distance_values:
      return "a corner does not have one value for each clip distance";
    case PolygonError::not_finite:
      return "a number of a corner is not finite";
    case PolygonError::location:
      return "an attribute of a polygon is not evaluated at samples";
    case PolygonError::degenerate:
      return "the polygon has no area as seen from the eye";
    case PolygonError::not_convex:
      return "the polygon is not convex as seen from the eye, or its corners are not in order";
  }
  return "";
}

std::optional<PolygonFault> draw_polygon(std::string_view method, const State& state,
                                         std::span<const PolygonVertex> polygon,
                                         const TargetSize& size, Fragments& fragments) {
  const Method* found = find_method(method);
  if (found == nullptr) return PolygonFault{PolygonError::draw, 0, Error::unknown_method};
  if (found->draw_polygon == nullptr) return PolygonFault{PolygonError::no_polygons};
  std::optional<Error> refused = check_size(size);
  if (!refused) refused = check_state(state);
  if (refused) return PolygonFault{PolygonError::draw, 0, refused};
  if (const auto fault = check_polygon(state, polygon)) return fault;

  std::vector<glm::vec4> positions;
  std::vector<float> attributes;
  std::vector<float> clip_distances;
  for (const PolygonVertex& corner : polygon) {
    positions.push_back(corner.position);
    attributes.insert(attributes.end(), corner.attributes.begin(), corner.attributes.end());
    clip_distances.insert(clip_distances.end(), corner.clip_distances.begin(),
                          corner.clip_distances.end());
  }
  const Mesh mesh{positions, attributes, clip_distances, {}};
  const auto draw = [found](const State& s, const Mesh& m, const TargetSize& t, Fragments& f) {
    return found->draw_polygon(s, m, t, f, nullptr);
  };
  refused = draw_checked(draw, state, mesh, size, fragments).error;
  if (refused) return PolygonFault{PolygonError::draw, 0, refused};
  return std::nullopt;
}

}  // namespace rastercheck::rasterizer
