#pragma once

// The triangles that a split compares (oracle/stage_split.h).

#include <cstdint>
#include <optional>

#include "cases/case.h"
#include "cases/contract.h"
#include "oracle/internal/line.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/values.h"
#include "oracle/stage_split.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// A triangle drawn alone under a contract.
struct TriangleUnder {
  TriangleUnder(const cases::Case& alone, const cases::Contract& contract)
      : scene(alone, contract), truth(scene, 0), values(truth.setup()) {}

  const TriangleSetup& setup() const { return truth.setup(); }

  /// The value of the triangle that the basis names, interpolated as the rules say; empty if the
  /// rules leave the value undefined. Not for flat attributes.
  std::optional<Field> value_at(std::optional<std::uint32_t> attribute, const Point& p) const;

  SceneTruth scene;
  TriangleTruth truth;
  TriangleValues values;
};

struct StageSplit::Triangles {
  Triangles(const cases::Case& given_alone, const cases::Case& drawn_alone,
            const cases::Contract& contract);

  /// V_0, and the place where it is evaluated.
  struct Start {
    Field value;
    Point place;
  };
  /// `taken` is the place where the backend evaluated the value, if known.
  std::optional<Start> start(std::optional<std::uint32_t> attribute, int x, int y, int sample,
                             const std::optional<Point>& taken) const;
  /// The value of a flat attribute; empty for other attributes and the depth.
  std::optional<Field> copy_of(std::optional<std::uint32_t> attribute) const;
  /// Clamps a depth as the rules do; returns attributes unchanged.
  Field clamped(std::optional<std::uint32_t> attribute, Field value) const;
  /// The triangle's depth bias; 0 for attributes, and without a bias.
  static Field offset_of(const TriangleUnder& triangle, std::optional<std::uint32_t> attribute);
  /// The scale ULP for errors against an exact value.
  Rational unit(std::optional<std::uint32_t> attribute, const Field& exact) const;

  TriangleUnder given;  ///< exact, from the object positions
  TriangleUnder drawn;  ///< exact, from the clip positions
  TriangleUnder open;   ///< from the clip positions, under the contract

 private:
  std::optional<Point> centroid(int x, int y, const std::optional<Point>& taken) const;
  bool may_be_centroid(int x, int y, const Point& p) const;
};

}  // namespace rastercheck::oracle
