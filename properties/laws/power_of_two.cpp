// A power of two changes no bit: multiplying all clip coordinates of a triangle's vertices by the
// same 2^k gives the same fragments, bit for bit.
//
// Why. A clip position is homogeneous: (X, Y, w) and its multiple are the same point of the window.
// M becomes 2^k M and E_i = sign(det M) adj(M) (u, v, 1) becomes 4^k E_i: signs, ties, facing and
// the ratios that make up values stay the same, and so do the signs of clip functionals, which are
// homogeneous in e (RULES §1, §2). User clip distances may be scaled or not; both give the same
// cut.
//
// So the exact values are the same. The bits are the same because rounding commutes with powers of
// two: +, −, ×, / and comparisons of numbers that are 2^a and 2^b times as large give the same
// digits, as long as no exponent overflows or underflows. Two things break this: comparing a
// coordinate with a constant, such as the least w to divide by or the area below which a triangle
// is dropped, and adding numbers of different degree. No part of a contract depends on the size of
// a coordinate, so no backend has a reason for either.
//
// Coordinates: k is chosen so that every coordinate stays a finite float32 with the same digits,
// and normal if it was normal. k is chosen at random (choices.h) and differs from triangle to
// triangle. So triangles get vertices of their own, also in the drawing for comparison. A case is
// left out if each of its triangles spans the whole range of float32.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/same_drawing.h"

namespace rastercheck::properties::power_of_two_law {
namespace {

/// Exponents of normal float32.
constexpr int kLeastExponent = -126;
constexpr int kMostExponent = 127;
/// Most factors are within 2^±kMostUsual.
constexpr int kMostUsual = 8;

/// Returns the case with three vertices of its own for each triangle, in order.
cases::Case with_own_vertices(const cases::Case& c) {
  cases::Case own = c;
  own.positions.clear();
  own.attribute_values.clear();
  own.clip_distances.clear();
  std::uint32_t next = 0;
  for (cases::Triangle& triangle : own.triangles) {
    for (std::uint32_t& vertex : triangle) {
      own.positions.push_back(c.positions[vertex]);
      const auto values = c.attributes_of(vertex);
      own.attribute_values.insert(own.attribute_values.end(), values.begin(), values.end());
      const auto distances = c.clip_distances_of(vertex);
      own.clip_distances.insert(own.clip_distances.end(), distances.begin(), distances.end());
      vertex = next++;
    }
  }
  return own;
}

/// The exponents k with least <= k <= most.
struct Powers {
  int least = kLeastExponent - kMostExponent;
  int most = kMostExponent - kLeastExponent;

  /// Keeps only those k for which `number` times 2^k keeps its digits.
  void take(float number) {
    if (number == 0) return;
    const int exponent = std::ilogb(number);
    least = std::max(least, exponent < kLeastExponent ? 0 : kLeastExponent - exponent);
    most = std::min(most, kMostExponent - exponent);
  }
};

Powers exponents_of(const cases::Case& c, const cases::Triangle& triangle, bool has_distances) {
  Powers all;
  for (const std::uint32_t vertex : triangle) {
    const cases::ClipVertex& p = c.positions[vertex];
    for (const float coordinate : {p.x, p.y, p.z, p.w}) all.take(coordinate);
    if (!has_distances) continue;
    for (const float distance : c.clip_distances_of(vertex)) all.take(distance);
  }
  return all;
}

/// Chooses a nonzero exponent, more often a small one; 0 if no other is possible.
int exponent_of(Choices& choices, Powers all) {
  if (choices.below(4) > 0) {
    all.least = std::max(all.least, -kMostUsual);
    all.most = std::min(all.most, kMostUsual);
  }
  if (all.least >= all.most) return 0;
  const auto chosen =
      static_cast<int>(choices.below(static_cast<std::size_t>(all.most - all.least)));
  return all.least + chosen < 0 ? all.least + chosen : all.least + chosen + 1;
}

float scaled(float number, int exponent) { return std::ldexp(number, exponent); }

/// A scaled case whose triangles have their own vertices, and labels that say how it was scaled.
struct ScaledCase {
  cases::Case source;
  std::set<std::string> labels;
  bool is_changed = false;
};

ScaledCase scaled_case(const cases::Case& own, std::uint64_t all) {
  // The upper half of an FNV hash is better mixed.
  const std::uint64_t hash = all ^ (all >> 32);
  const bool has_distances = own.clip_distance_count > 0 && hash % 2 == 0;
  ScaledCase result{own, {}, false};
  cases::Case& c = result.source;
  for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
    // Each triangle gets its own choices.
    Choices choices(hash / 2 + t * std::uint64_t{0x9e3779b97f4a7c15});
    const int k = exponent_of(choices, exponents_of(c, c.triangles[t], has_distances));
    if (k == 0) continue;
    result.is_changed = true;
    result.labels.emplace(k > 0 ? "larger" : "smaller");
    if (std::abs(k) > kMostUsual) result.labels.emplace("far");
    if (has_distances) result.labels.emplace("scaled clip distances");
    for (const std::uint32_t vertex : c.triangles[t]) {
      cases::ClipVertex& p = c.positions[vertex];
      p = {scaled(p.x, k), scaled(p.y, k), scaled(p.z, k), scaled(p.w, k)};
      if (!has_distances) continue;
      for (std::size_t d = 0; d < c.clip_distance_count; ++d) {
        float& distance = c.clip_distances[vertex * c.clip_distance_count + d];
        distance = scaled(distance, k);
      }
    }
  }
  return result;
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  const cases::Case own = with_own_vertices(clip);
  const ScaledCase changed = scaled_case(own, choices_of(clip));
  if (!changed.is_changed) return not_applicable("no number can be scaled by a power of two");
  const Result<backends::Drawn> before = draw_promised(own, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(changed.source, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  Check check = compare_drawings(own, before->fragments, drawn->fragments,
                                 "drawn with all coordinates multiplied by a power of two");
  for (const std::string& label : changed.labels) add_label(check, label);
  return check;
}

const LawRegistration kRegistration(
    {.id = "a-power-of-two-changes-no-bit",
     .sentence = "a power of two changes no bit",
     .reason = "Clip positions are homogeneous, and rounding commutes with powers of two.",
     .exceptions =
         "triangles whose coordinates fill the whole range of float32; backends that promise no "
         "invariance",
     .generate = &generate_any,
     .check = &check,
     .is_promised = &draws_invariantly,
     .unpromised = "the backend does not promise that irrelevant changes leave all bits unchanged",
     .covers = {cover(35, "larger"), cover(35, "smaller"), cover(25, "far"), cover(10, "clipped"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::power_of_two_law
