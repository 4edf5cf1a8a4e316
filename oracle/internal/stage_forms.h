#pragma once

// What stages hand on (records/stage_trace.h) as exact functions of the window position: the forms
// that a value takes on its way (oracle/stage_split.h).

#include <array>
#include <functional>
#include <optional>

#include "cases/case.h"
#include "oracle/internal/line.h"
#include "oracle/internal/number.h"
#include "oracle/internal/projective_map.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/triangle_truth.h"
#include "records/stage_trace.h"

namespace rastercheck::oracle {

/// The case with one of its triangles and with just that triangle's vertices, in its order.
cases::Case triangle_alone(const cases::Case& c, std::uint32_t triangle);

/// A triangle alone with the clip positions that a backend received; nothing where one is not
/// finite.
std::optional<cases::Case> received_case(const records::SampleTrace& trace, cases::Case alone);

/// Numbers, one for each corner.
using Weights = std::array<Ring, 3>;

/// What a value is: Σ n_c E_c / Σ d_c E_c, for any common multiple E_c of e_c.
struct Terms {
  Weights numerators;
  Weights denominators;

  /// Nothing where the denominator is 0.
  std::optional<Field> at(const Weights& weights) const;
  /// The mean of the corners' values by these shares; nothing where they add up to 0, or a corner
  /// has no value.
  std::optional<Field> mean(const Weights& shares) const;
};

/// What is drawn of a triangle, as some stage has it: its vertices or three other corners.
struct Corners {
  std::array<RingVector3, 3> columns;  ///< (x w, y w, w), x and y in pixels
  std::array<RingVector3, 3> shares;   ///< of the vertices
  Weights depths;                      ///< depth times w

  /// Whether they are the vertices, if maybe moved.
  bool are_vertices() const;
};
Corners vertices_of(const TriangleSetup& triangle);
/// Nothing where a number is not finite.
std::optional<Corners> traced_corners(const std::array<records::TracedCorner, 3>& corners,
                                      const Scene& scene);

/// An attribute's terms, or those of the depth where `attribute` is nothing. Values and w of the
/// vertices come from the triangle. Not of flat attributes.
Terms terms_of(const Corners& corners, const TriangleSetup& triangle,
               std::optional<std::uint32_t> attribute);

/// A value as a function of the window position; nothing where it has none.
using Form = std::function<std::optional<Field>(const Point&)>;
Form form_of(const Corners& corners, const Terms& terms);
/// Lines and planes; nothing where a number is not finite.
std::optional<Form> form_of(const std::array<records::TracedLine, 3>& lines,
                            const records::TracedFrame& frame, const Terms& terms);
std::optional<Form> form_of(const records::TracedPlane& numerator,
                            const std::optional<records::TracedPlane>& denominator,
                            const records::TracedFrame& frame);

/// A traced line as a functional of window positions in pixels.
std::optional<Line> window_line(const records::TracedLine& line, const records::TracedFrame& frame);

/// Exactly the numbers; nothing where one is not finite.
std::optional<Weights> exact_weights(const std::array<double, 3>& weights);
std::optional<Point> exact_point(double u, double v);

}  // namespace rastercheck::oracle
