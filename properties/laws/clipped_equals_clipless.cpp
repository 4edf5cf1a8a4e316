// Clipped equals clipless: a triangle that reaches beyond a plane, and the polygon that remains
// after clipping at that plane, draw the same samples with the same values. If a rasterizer clips,
// the law compares its drawings with and without something to clip; a rasterizer without a clipper
// must draw both alike, too.
//
// Why. A clip plane is one more functional, L = Σ e_i L_i >= 0, with values L_i at the vertices
// (RULES §2). Clipping leaves the polygon of the vertices with L_i > 0 and of the points p = (L_j
// p_i − L_i p_j)/(L_j − L_i) on edges that the plane cuts. Attributes, depths and other distances
// are linear in clip space too, so the polygon's triangles have the same map as the whole (§1). If
// the L_i are ±1 or ±3 units, the points p are means of two vertices with weights 1/4, 1/2 or 3/4.
// These are exact in float32 if the vertices' numbers have few bits, so the polygon is exact. The
// planes are
//
//   near, far             L = z (OpenGL: z + w), w − z      the depth clamp is turned off
//   a side                L = w ± x, w ± y                  nothing is drawn beyond it
//   a clip distance       L = d
//   near, through eye     L as for near; w = L + 1/2 unit, so that w < 0 at vertices with L < 0
//
// Both drawings are within the bound of the same exact value, so they differ by at most twice the
// bound. For attributes and depth tests see laws/splitting_a_triangle.cpp.
//
// Samples: all but those with L = 0. There, the polygon follows the fill rule for its new edge,
// whose direction decides, but the triangle follows the rule for its plane: zeros of depth planes,
// and under D3D also of clip distances, count as inside. The exact value of an attribute that
// equals L at the vertices tells whether L is 0. For what snapping leaves open see
// internal/parted_triangles.h.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "cases/capabilities.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/parted_triangles.h"
#include "properties/laws/internal/verdicts.h"

namespace rastercheck::properties::clipped_equals_clipless_law {
namespace {

using cases::ClipVertex;
using cases::Triangle;

enum class Plane { near, far, left, right, low, high, distance, near_through_eye };
/// Depth planes and clip distances are listed twice, to be chosen twice as often as each side.
constexpr std::array kPlanes{Plane::near,
                             Plane::near,
                             Plane::far,
                             Plane::far,
                             Plane::left,
                             Plane::right,
                             Plane::low,
                             Plane::high,
                             Plane::near_through_eye,
                             Plane::near_through_eye,
                             Plane::distance,
                             Plane::distance};

/// L at the vertices, in units, with both signs: one or two vertices lie beyond the plane.
using Units = std::array<int, 3>;
constexpr std::array kUnits{Units{1, 1, -1},  Units{3, 3, -1},  Units{1, 1, -3},  Units{3, 1, -1},
                            Units{1, -1, -1}, Units{3, -1, -1}, Units{1, -3, -3}, Units{3, -3, -1}};

/// The unit of L: half of the power of two at or below the greatest of the other numbers in L, so
/// that sums of L and these numbers stay short (with_short_vertices). Returns nothing if sums might
/// leave float32.
std::optional<double> unit_of(const cases::Case& c, const Triangle& triangle, Plane plane) {
  double greatest = 0;
  for (const std::uint32_t vertex : triangle) {
    const ClipVertex& p = c.positions[vertex];
    const float magnitude =
        plane == Plane::near_through_eye ? std::max(std::abs(p.x), std::abs(p.y)) : std::abs(p.w);
    greatest = std::max(greatest, double{magnitude});
  }
  if (greatest >= 0x1p120) return std::nullopt;
  if (greatest == 0) return 1;
  return std::ldexp(1.0, std::max(std::ilogb(greatest) - 1, -140));
}

/// Moves a vertex so that L is `units` there.
void place(cases::Case& c, std::uint32_t vertex, Plane plane, double unit, int units) {
  ClipVertex& p = c.positions[vertex];
  const auto value = static_cast<float>(units * unit);
  const bool is_opengl = c.rules == cases::Rules::opengl;
  switch (plane) {
    case Plane::near:
      p.z = is_opengl ? value - p.w : value;
      break;
    case Plane::far:
      p.z = p.w - value;
      break;
    case Plane::left:
      p.x = value - p.w;
      break;
    case Plane::right:
      p.x = p.w - value;
      break;
    case Plane::low:
      p.y = value - p.w;
      break;
    case Plane::high:
      p.y = p.w - value;
      break;
    case Plane::distance:
      c.clip_distances[vertex * c.clip_distance_count] = value;
      break;
    case Plane::near_through_eye:  // w is half a unit where L = 0
      p.w = static_cast<float>((units + 0.5) * unit);
      p.z = is_opengl ? value - p.w : value;
  }
}

const char* word_of(Plane plane) {
  switch (plane) {
    case Plane::near:
      return "near plane";
    case Plane::far:
      return "far plane";
    case Plane::distance:
      return "clip distance";
    case Plane::near_through_eye:
      return "through the eye";
    default:
      return "side of the viewport";
  }
}

/// The corners of the clipped triangle, in order: the vertices inside, and the points where edges
/// cross the plane.
std::vector<std::uint32_t> clipped(cases::Case& c, const Triangle& triangle, const Units& units) {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (units[i] > 0) corners.push_back(triangle[i]);
    if ((units[i] > 0) == (units[j] > 0)) continue;
    std::array<int, 3> quarters{};
    quarters[i] = 4 * -units[j] / (units[i] - units[j]);
    quarters[j] = 4 - quarters[i];
    corners.push_back(add_mixed(c, triangle, quarters));
  }
  return corners;
}

struct PlaneClipping {
  Parted parted;
  cases::Case with_l;  ///< the whole, with L in units as its only attribute
  Plane plane = Plane::near;
};

/// The planes at which a backend clips.
std::vector<Plane> planes_of(const cases::Capabilities& has) {
  using cases::Feature;
  const auto is_there = [&has](Plane plane) {
    switch (plane) {
      case Plane::near:
      case Plane::far:
        return has.has(Feature::depth_clipping);
      case Plane::near_through_eye:
        return has.has(Feature::depth_clipping) && has.has(Feature::nonpositive_w);
      case Plane::distance:
        return has.has(Feature::clip_distances) && has.max_clip_distances > 0;
      default:
        return has.has(Feature::side_clipping);
    }
  };
  std::vector<Plane> planes;
  std::copy_if(kPlanes.begin(), kPlanes.end(), std::back_inserter(planes), is_there);
  return planes;
}

PlaneClipping clipping_of(const cases::Case& c, const std::vector<Plane>& planes) {
  Choices choices(choices_of(c));
  PlaneClipping result;
  result.plane = planes[choices.below(planes.size())];
  cases::Case source = c;
  if (result.plane == Plane::distance && source.clip_distance_count == 0) {
    source.clip_distance_count = 1;
    source.clip_distances.assign(source.positions.size(), 1);
  }
  const bool is_of_depth = result.plane == Plane::near || result.plane == Plane::far ||
                           result.plane == Plane::near_through_eye;
  if (is_of_depth) source.depth_clamp = false;

  cases::Case& whole = result.parted.whole;
  whole = with_short_vertices(source);
  std::vector<Units> units_of;
  for (const Triangle& triangle : whole.triangles) {
    Units units = choices.pick(kUnits);
    std::rotate(units.begin(), units.begin() + static_cast<int>(choices.below(3)), units.end());
    const std::optional<double> unit = unit_of(whole, triangle, result.plane);
    if (!unit) units = {1, 1, 1};
    for (std::size_t i = 0; unit && i < 3; ++i) {
      place(whole, triangle[i], result.plane, *unit, units[i]);
    }
    units_of.push_back(units);
  }

  cases::Case& parts = result.parted.parts;
  parts = whole;
  parts.triangles.clear();
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
    const std::vector<std::uint32_t> corners = clipped(parts, whole.triangles[t], units_of[t]);
    for (std::size_t i = 2; i < corners.size(); ++i) {
      parts.triangles.push_back({corners[0], corners[i - 1], corners[i]});
      result.parted.triangle_of.push_back(t);
    }
  }
  result.parted.note =
      std::string("drawn as the part that remains at the ") + word_of(result.plane);

  result.with_l = whole;
  result.with_l.attributes = {{"L", cases::Interpolation::smooth, cases::Location::sample}};
  result.with_l.attribute_values.clear();
  for (const Units& units : units_of) {
    for (const int l : units) result.with_l.attribute_values.push_back(static_cast<float>(l));
  }
  return result;
}

/// True if L is 0 at a sample that the whole may draw.
bool is_on_plane(Verdicts& with_l, const cases::SamplePlace& place) {
  const auto verdict = with_l.judge(place.triangle, place).verdict;
  if (verdict == records::Verdict::forbidden) return false;
  const auto l = with_l.truth(place.triangle)
                     .attribute(0, static_cast<int>(place.x), static_cast<int>(place.y),
                                static_cast<int>(place.sample));
  return l && l->lo == oracle::Rational(0);
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  const std::vector<Plane> planes = planes_of(backend.about().capabilities);
  if (planes.empty()) return not_applicable("the backend does not clip at any plane");
  PlaneClipping clipping = clipping_of(clip, planes);
  cases::Contract exact;
  exact.tie_rule = cases::TieRule::unspecified;  // so that no tie is forbidden
  Verdicts with_l(clipping.with_l, exact);
  bool has_zero = false;
  clipping.parted.is_exempt = [&](const cases::SamplePlace& place) {
    const bool is_zero = is_on_plane(with_l, place);
    has_zero = has_zero || is_zero;
    return is_zero;
  };
  Result<Check> found = check_parted(clipping.parted, backend);
  if (!found) return found;
  const bool is_drawn = found->judgement.counts.required > 0;
  if (is_drawn) add_label(*found, word_of(clipping.plane));
  if (has_zero) add_label(*found, "sample on the plane");
  return found;
}

const LawRegistration kRegistration(
    {.id = "clipped-equals-clipless",
     .sentence = "clipped equals clipless",
     .reason = "A clip plane is one more functional, and the polygon that it leaves has the map of "
               "the whole.",
     .exceptions = "samples on the plane; near the outline of snapped triangles, and their values; "
                   "noperspective and flat attributes, which are made smooth",
     .generate = &generate_any,
     .check = &check,
     .is_promised = &draws_all_parts_once,
     .unpromised = "the backend does not promise that parts cover, once, what the whole covers",
     .needs_samples = true,
     .covers = {cover(5, "clip distance"), cover(5, "far plane"), cover(5, "near plane"),
                cover(12, "side of the viewport"), cover_decided(15, "snapped"),
                cover(5, "through the eye"), cover(10, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::clipped_equals_clipless_law
