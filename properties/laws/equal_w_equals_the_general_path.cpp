// Equal w equals the general path: a triangle whose vertices have the same w, and the same triangle
// with each vertex scaled by its own power of two, draw the same samples with the same values. So
// if a rasterizer skips the division for equal w, its values must agree with those of its general
// path to within both bounds (RULES §6).
//
// Why. A clip position times a factor f_i > 0 appears at the same place, and e_i becomes e_i / f_i.
// These do not change:
//
//   coverage, facing      the signs of e_i stay
//   z/w = Σ e_i z_i       as z_i becomes f_i z_i; and so near, far and the depth
//   f   = Σ e_i d_i       if the clip distance d_i gets the factor, too
//   noperspective         Σ r_i w_i e_i
//
// If w is the same everywhere, a smooth attribute is Σ r_i e_i / Σ e_i = Σ r_i w_i e_i, like a
// noperspective attribute, so it is compared with a noperspective attribute of the scaled triangle.
// Two smooth attributes of the scaled triangle test the path that divides: m with m_i = f_i r_i and
// n with n_i = f_i. m = Σ r_i e_i / D and n = Σ e_i / D have the quotient r = Σ r_i e_i / Σ e_i.
//
// How far apart values may be. Two computed values of the same exact value may differ by both
// bounds together (close_drawings.h). For the quotient, let m + a and n + b be computed in the
// scaled triangle, and r + c in the triangle of equal w. Then
//
//   (m + a) − (r + c)(n + b) = a − r b − c (n + b)     as m = r n
//   |m' − r' n'| <= A + max|r_i| B + C |n'|             A, B, C the bounds of each
//
// where primes mark computed numbers; rounding the left side costs at most 2^-52 |r' n'|.
//
// Factors are 2^k, |k| <= 4, and so is w, so that nothing is rounded. Attributes are located at the
// sample. There, |r| <= max|r_i|, except at samples that only snapping covers if values come from
// exact positions. Under contracts with such samples, the quotient is not compared. The depth test
// is off. Samples: all, except those that the contract leaves open and that only one drawing has.
// Window positions are the same numbers in both cases, so a contract that names the rounding moves
// them alike. The contract does not say where clipping puts the new vertices of snapped triangles.
// So values from snapped positions are not compared for clipped triangles, and for no triangle if
// the contract names no rounding.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/close_drawings.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/window_position.h"

namespace rastercheck::properties::equal_w_equals_the_general_path_law {
namespace {

using cases::ClipVertex;
using cases::Interpolation;
using records::FragmentClass;

/// The number times a power of two, if that is float32.
std::optional<float> scaled(float number, double factor) {
  const double product = double{number} * factor;
  const float rounded = to_float(product);
  if (double{rounded} != product) return std::nullopt;
  return rounded;
}

/// Brings a vertex's coordinate to w = 1. A vertex in front of the eye still appears at the same
/// place. The result stays away from float32's limits, so that factors leave it exact.
float at_equal_w(float coordinate, float w) {
  const double divisor = w > 0 ? double{w} : 1;
  const double moved = std::clamp(double{coordinate} / divisor, -0x1p100, 0x1p100);
  return std::abs(moved) < 0x1p-100 ? 0.0F : static_cast<float>(moved);
}

/// The case with a single w, and the same case with scaled vertices.
struct CasePair {
  cases::Case equal;
  cases::Case general;
  std::vector<double> factors;  ///< [vertex]
  /// The attribute from which m and n are made; empty if they cannot be exact. In `general`, m and
  /// n follow the attributes of `equal`.
  std::optional<std::size_t> quotient_of;
};

/// An attribute whose products with the factors are float32, if any.
std::optional<std::size_t> attribute_for_quotient(const CasePair& pair) {
  for (std::size_t a = 0; a < pair.equal.attributes.size(); ++a) {
    if (pair.equal.attributes[a].interpolation == Interpolation::flat) continue;
    bool is_exact = true;
    for (std::size_t v = 0; v < pair.factors.size(); ++v) {
      is_exact = is_exact && scaled(pair.equal.attributes_of(v)[a], pair.factors[v]).has_value();
    }
    if (is_exact) return a;
  }
  return std::nullopt;
}

/// Adds the attributes m and n.
void add_quotient(CasePair& pair) {
  pair.quotient_of = attribute_for_quotient(pair);
  if (!pair.quotient_of || pair.equal.attributes.size() + 2 > cases::kMaxAttributes) {
    pair.quotient_of.reset();
    return;
  }
  cases::Case& general = pair.general;
  general.attributes.push_back({"m", Interpolation::smooth, cases::Location::sample});
  general.attributes.push_back({"n", Interpolation::smooth, cases::Location::sample});
  general.attribute_values.clear();
  for (std::size_t v = 0; v < pair.factors.size(); ++v) {
    const auto values = pair.equal.attributes_of(v);
    general.attribute_values.insert(general.attribute_values.end(), values.begin(), values.end());
    general.attribute_values.push_back(*scaled(values[*pair.quotient_of], pair.factors[v]));
    general.attribute_values.push_back(static_cast<float>(pair.factors[v]));
  }
}

CasePair pair_of(const cases::Case& c) {
  CasePair pair;
  cases::Case& equal = pair.equal;
  equal = c;
  equal.depth_test = cases::DepthTest::none;
  for (cases::Attribute& attribute : equal.attributes) {
    attribute.location = cases::Location::sample;
  }
  Choices choices(choices_of(c));
  const auto w = static_cast<float>(std::ldexp(1.0, static_cast<int>(choices.below(9)) - 4));
  for (ClipVertex& p : equal.positions) {
    p = {w * at_equal_w(p.x, p.w), w * at_equal_w(p.y, p.w), w * at_equal_w(p.z, p.w), w};
  }
  for (float& distance : equal.clip_distances) distance = at_equal_w(distance, 1);

  pair.general = equal;
  for (cases::Attribute& attribute : pair.general.attributes) {
    if (attribute.interpolation == Interpolation::smooth) {
      attribute.interpolation = Interpolation::noperspective;
    }
  }
  for (std::size_t v = 0; v < equal.positions.size(); ++v) {
    if (v % 8 == 0) choices = Choices(choices_of(c) + v);
    const double factor = std::ldexp(1.0, static_cast<int>(choices.below(9)) - 4);
    pair.factors.push_back(factor);
    ClipVertex& p = pair.general.positions[v];
    p = {static_cast<float>(double{p.x} * factor), static_cast<float>(double{p.y} * factor),
         static_cast<float>(double{p.z} * factor), static_cast<float>(double{p.w} * factor)};
    for (std::size_t d = 0; d < equal.clip_distance_count; ++d) {
      float& distance = pair.general.clip_distances[v * equal.clip_distance_count + d];
      distance = static_cast<float>(double{distance} * factor);
    }
  }
  add_quotient(pair);
  return pair;
}

/// Returns a drawing with only its first `count` attributes and no derivatives.
cases::Fragments with_attributes(const cases::Fragments& drawn, std::size_t count) {
  cases::Fragments result = drawn;
  result.derivatives.clear();
  result.attribute_count = count;
  result.attributes.clear();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto values = drawn.attributes_of(i).first(count);
    result.attributes.insert(result.attributes.end(), values.begin(), values.end());
  }
  return result;
}

class PathsCheck {
 public:
  PathsCheck(const CasePair& pair, backends::Backend& backend)
      : pair_(&pair),
        of_equal_(backend.contract(pair.equal)),
        of_general_(backend.contract(pair.general)),
        verdicts_(pair.equal, of_equal_),
        verdicts_of_general_(pair.general, of_general_) {}

  Check run(const cases::Fragments& equal, const cases::Fragments& general) {
    constexpr const char* kNote = "drawn with each vertex scaled by another power of two";
    Closeness closeness;
    closeness.note = kNote;
    closeness.is_open = [this](const cases::SamplePlace& place) { return is_open(place); };
    closeness.allowed = [this](std::uint32_t triangle, std::optional<std::uint32_t> attribute) {
      return allowed(triangle, attribute);
    };
    closeness.is_undefined = [this](const cases::SamplePlace& place,
                                    std::optional<std::uint32_t> attribute) {
      return verdicts_.is_undefined(place, attribute);
    };
    const std::size_t count = pair_->equal.attributes.size();
    Check check = compare_close(pair_->equal, equal, with_attributes(general, count), closeness);
    if (pair_->quotient_of) see_quotients(equal, general, check);
    if (of_equal_.coverage) add_label(check, "snapped");
    if (has_quotient_) add_label(check, "quotient");
    return check;
  }

 private:
  /// True if the contract places the vertices of both cases alike and bounds the values.
  bool has_values(std::uint32_t triangle) {
    if (!of_equal_.coverage || of_equal_.basis == cases::Basis::ideal) return true;
    if (of_equal_.is_unspecified() || of_general_.is_unspecified()) return false;
    return verdicts_.truth(triangle).has_certain_orientation();
  }

  bool is_open(const cases::SamplePlace& place) {
    return verdicts_.judge(place.triangle, place).verdict == records::Verdict::permitted ||
           verdicts_of_general_.judge(place.triangle, place).verdict == records::Verdict::permitted;
  }

  std::optional<ValueAllowance> bound_of(const cases::Case& c, const cases::Contract& contract,
                                         std::uint32_t triangle,
                                         std::optional<std::size_t> attribute) {
    if (!has_values(triangle)) return std::nullopt;
    if (!attribute) return depth_allowance(c, contract);
    return value_allowance(c, contract, c.triangles[triangle], *attribute);
  }

  std::optional<ValueAllowance> allowed(std::uint32_t triangle,
                                        std::optional<std::size_t> attribute) {
    const auto one = bound_of(pair_->equal, of_equal_, triangle, attribute);
    const auto other = bound_of(pair_->general, of_general_, triangle, attribute);
    if (!one || !other) return std::nullopt;
    return ValueAllowance{one->units + other->units, one->magnitude};
  }

  void see_quotients(const cases::Fragments& equal, const cases::Fragments& general, Check& check) {
    const auto leave_out = [](const auto&... /*of_one*/) {};
    visit_places(
        equal, general,
        [&](const cases::SamplePlace& place, std::size_t of_equal, std::size_t of_general) {
          if (!is_of_case(pair_->equal, place)) return;
          see_quotient(place, equal.attributes_of(of_equal)[*pair_->quotient_of],
                       general.attributes_of(of_general), check);
        },
        leave_out, leave_out);
  }

  /// The bounds A, B, C of a triangle, and max|r_i|.
  struct Bounds {
    double m = 0;
    double n = 0;
    double r = 0;
    double greatest = 0;
  };

  std::optional<Bounds> bounds_of(std::uint32_t triangle) {
    if (bounds_ && triangle_ == triangle) return bounds_;
    triangle_ = triangle;
    const std::size_t a = *pair_->quotient_of;
    const std::size_t m = pair_->equal.attributes.size();
    const auto of_m = bound_of(pair_->general, of_general_, triangle, m);
    const auto of_n = bound_of(pair_->general, of_general_, triangle, m + 1);
    const auto of_r = bound_of(pair_->equal, of_equal_, triangle, a);
    bounds_.reset();
    const bool is_covered =
        !of_equal_.coverage || of_equal_.basis == cases::Basis::snapped;  // in the values' basis
    if (!is_covered) return bounds_;
    if (!of_m || !of_n || !of_r) return bounds_;
    const auto in_values = [](const ValueAllowance& one) {
      return one.units * ulp_of(one.magnitude);
    };
    bounds_ = {in_values(*of_m), in_values(*of_n), in_values(*of_r), of_r->magnitude};
    return bounds_;
  }

  void see_quotient(const cases::SamplePlace& place, float r, std::span<const float> values,
                    Check& check) {
    const std::optional<Bounds> bounds = bounds_of(place.triangle);
    if (!bounds) return;
    has_quotient_ = true;
    const std::size_t m = pair_->equal.attributes.size();
    const double product = number_of(r) * number_of(values[m + 1]);
    const double off = std::abs(number_of(values[m]) - product);
    const double most = bounds->m + bounds->greatest * bounds->n +
                        bounds->r * std::abs(number_of(values[m + 1])) +
                        0x1p-50 * std::abs(product);
    if (off <= most * (1 + 0x1p-50)) return;
    const auto attribute = static_cast<std::uint32_t>(*pair_->quotient_of);
    add_violation(check, violation_at(place, class_of_wrong(values[m], FragmentClass::beyond_bound),
                                      "the quotient of two smooth attributes, " +
                                          value_text(values[m + 1]) + " · " + value_text(r),
                                      "drawn with each vertex scaled by another power of two",
                                      {records::AttributeKind::smooth, attribute, values[m]}));
  }

  const CasePair* pair_;
  cases::Contract of_equal_;
  cases::Contract of_general_;
  Verdicts verdicts_;
  Verdicts verdicts_of_general_;
  std::optional<Bounds> bounds_;
  bool has_quotient_ = false;  ///< true if any quotient was compared
  std::uint32_t triangle_ = std::numeric_limits<std::uint32_t>::max();
};

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  const CasePair pair = pair_of(clip);
  const Result<backends::Drawn> equal = draw_promised(pair.equal, backend);
  if (!equal) return tl::unexpected(equal.error());
  const Result<backends::Drawn> general = draw_promised(pair.general, backend);
  if (!general) return tl::unexpected(general.error());
  return PathsCheck(pair, backend).run(equal->fragments, general->fragments);
}

const LawRegistration kRegistration(
    {.id = "equal-w-equals-the-general-path",
     .sentence = "equal w equals the general path",
     .reason = "A vertex times a factor appears where it did, and what is made of products with "
               "e_i is the same number.",
     .exceptions = "values of clipped triangles whose vertices are snapped, and of those that a "
                   "contract places it does not say where",
     .generate = &generate_any,
     .check = &check,
     .excludes_outer = true,
     .covers = {cover(10, "clipped"), cover_decided(20, "quotient"), cover(15, "several samples"),
                cover_decided(15, "snapped")}});

}  // namespace
}  // namespace rastercheck::properties::equal_w_equals_the_general_path_law
