#pragma once

// The outputs of stages (records/stage_trace.h) as exact functions of the window position: the
// forms that a value takes from stage to stage (oracle/stage_split.h).

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

/// The case reduced to one triangle and its three vertices, in the triangle's order.
cases::Case triangle_alone(const cases::Case& c, std::uint32_t triangle);

/// The one-triangle case with the clip positions that the backend received; empty if one is not
/// finite.
std::optional<cases::Case> received_case(const records::SampleTrace& trace, cases::Case alone);

/// One number per corner.
using Weights = std::array<Ring, 3>;

/// A value as Σ n_c E_c / Σ d_c E_c, where all E_c are e_c times one common factor.
struct Terms {
  Weights numerators;
  Weights denominators;

  /// Empty if the denominator is 0.
  std::optional<Field> at(const Weights& weights) const;
  /// The mean of the corners' values with these shares as weights; empty if the shares sum to 0 or
  /// a corner has no value.
  std::optional<Field> mean(const Weights& shares) const;
};

/// The three corners of the drawn triangle at some stage: its vertices or other points.
struct Corners {
  std::array<RingVector3, 3> columns;  ///< (x w, y w, w), x and y in pixels
  std::array<RingVector3, 3> shares;   ///< each corner as weights of the vertices
  Weights depths;                      ///< depth times w

  /// True if the corners are the vertices, possibly moved.
  bool are_vertices() const;
};
Corners vertices_of(const TriangleSetup& triangle);
/// Empty if a number is not finite.
std::optional<Corners> traced_corners(const std::array<records::TracedCorner, 3>& corners,
                                      const Scene& scene);

/// The terms of an attribute, or of the depth if `attribute` is empty. Values and w of the vertices
/// come from the triangle. Not for flat attributes.
Terms terms_of(const Corners& corners, const TriangleSetup& triangle,
               std::optional<std::uint32_t> attribute);

/// A value as a function of the window position; empty where undefined.
using Form = std::function<std::optional<Field>(const Point&)>;
Form form_of(const Corners& corners, const Terms& terms);
/// The form that traced lines or planes give; empty if a number is not finite.
std::optional<Form> form_of(const std::array<records::TracedLine, 3>& lines,
                            const records::TracedFrame& frame, const Terms& terms);
std::optional<Form> form_of(const records::TracedPlane& numerator,
                            const std::optional<records::TracedPlane>& denominator,
                            const records::TracedFrame& frame);

/// A traced line as a functional of window positions in pixels.
std::optional<Line> window_line(const records::TracedLine& line, const records::TracedFrame& frame);

/// Converts exactly; empty if a number is not finite.
std::optional<Weights> exact_weights(const std::array<double, 3>& weights);
std::optional<Point> exact_point(double u, double v);

}  // namespace rastercheck::oracle
