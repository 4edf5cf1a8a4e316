#pragma once

// The errors of one triangle's values relative to the ranges that the rules allow (oracle/judge.h).
//
// TriangleValues gives the exact range of a value, from up to 64 placements or from a polygon.
// Judging a computed f rarely needs the range: if one *reading* (a value certain to be in the
// range) is at most f and another at least f, f lies in the range. Each comparison is the sign of f
// d − n, in the ring. If all readings are on one side of f, the nearest of them is the end of the
// range.
//
//   placed   readings are the extreme placements' values, and the exact triangle's if the basis is
//            unspecified; at a sample, a placement's value is a mean of the vertices' values, so
//            the placements' range is clamped to the least and the greatest vertex value
//   cut      if the square of half-width `reach` around the point lies inside the polygon, readings
//            are the exact triangle's values at its corners, where a ratio of affine functions has
//            its extremes
//
// In all other cases (centroids, squares that leave the polygon, poles), TriangleValues gives the
// range.

#include <optional>
#include <vector>

#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/ulp_error.h"
#include "oracle/internal/values.h"

namespace rastercheck::oracle {

/// The errors of one value (oracle/judge.h).
struct ValueError {
  UlpError excess;
  std::optional<UlpError> ideal;
};

class ValueErrors {
 public:
  /// The triangle and the values must outlive the object.
  ValueErrors(const TriangleSetup& triangle, const TriangleValues& values);

  /// The errors of a computed value of an attribute, or of the depth if `attribute` is empty. A
  /// depth in a unorm format is its number of steps (stored_depth.h), and its errors are in steps.
  /// Returns nullopt if the rules leave the value undefined.
  std::optional<ValueError> of(std::optional<std::size_t> attribute, int x, int y, int sample,
                               const Ring& computed) const;

 private:
  struct Subject {
    Quantity quantity;
    /// The quantity that the ideal error refers to if the contract claims affine values; else
    /// empty.
    std::optional<Quantity> perspective;
    ScaleExponent scale;
    FractionRange ends;        ///< TriangleValues::ends
    bool is_clamped = false;   ///< true for a depth that the rules clamp
    FractionRange clamp = {};  ///< where it is clamped to
    /// A biased depth's offset, which is added to the quantity before clamping.
    std::optional<FractionRange> offset = {};
    bool has_ideal = true;  ///< false for stored depths that the contract leaves open
    Ring steps{1};          ///< what values of TriangleValues are multiplied by
    Fraction reach = {};    ///< by how much what is open is wider, because depths are stored
    // Made when first asked for.
    mutable std::optional<Reading> ideal;
    mutable std::vector<std::optional<Reading>> corners;
  };
  using Place = TriangleValues::Place;

  Subject depth_subject() const;
  void set_steps(Subject& subject) const;
  Subject attribute_subject(std::size_t attribute) const;
  const Reading& ideal(const Subject& subject) const;
  const Reading& corner(const Subject& subject, std::size_t index) const;
  static Fraction clamped(const Subject& subject, Fraction value);
  static int compare_clamped(const Subject& subject, const Ring& computed, const Fraction& value);

  std::optional<UlpError> single_excess(const Subject& subject, const Point& p, Place place,
                                        const Ring& computed) const;
  std::optional<UlpError> placed_excess(const Subject& subject, const Point& p, Place place,
                                        const Ring& computed) const;
  bool is_attained(const Subject& subject, const cases::Attribute& declared, int x, int y,
                   const Point& p, const Ring& computed) const;
  static UlpError beyond(const Subject& subject, Fraction lo, Fraction hi, const Ring& computed);
  static UlpError beyond_stored(const Subject& subject, const FractionRange& range,
                                const Ring& computed);
  std::optional<UlpError> ideal_error(const Subject& subject, const Point& p,
                                      const Ring& computed) const;

  const TriangleSetup* triangle_;
  const TriangleValues* values_;
  std::vector<Subject> subjects_;  ///< the depth, then the attributes
};

}  // namespace rastercheck::oracle
