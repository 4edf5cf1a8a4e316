#pragma once

// Traces how the value of one sample of a draw was computed, stage by stage, for reports that split
// an error by stage. Fields of a stage that did not run are empty. The numbers are, to the bit,
// those that the drawing used.

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A triangle, and a sample of a pixel.
struct SamplePlace {
  std::uint32_t triangle = 0;
  int x = 0;
  int y = 0;
  int sample = 0;
};

/// A corner of the drawn part of a triangle: a vertex, or a point that clipping made.
struct TracedCorner {
  double x = 0;  ///< window position in pixels; times w if `is_homogeneous`
  double y = 0;
  double z = 0;  ///< z and w are in clip space
  double w = 0;
  bool is_homogeneous = false;
  /// Share of each vertex in this corner: r = Σ share_v r_v.
  std::array<double, 3> share{};
};

/// A coordinate U or V of lines and planes: scale · (2 at − shift), where `at` is a window
/// coordinate in pixels.
struct TracedAxis {
  double scale = 0;
  double shift = 0;
};
struct TracedFrame {
  TracedAxis u;
  TracedAxis v;
  double t = 0;
};

/// The plane a U + (b V + c), each operation rounded to double. For a line: a U + (b V + c T).
struct TracedPlane {
  double a = 0;
  double b = 0;
  double c = 0;
};

/// Error bounds of the weights in double (rasterizer/internal/certificates.h).
struct TracedCertificate {
  std::array<double, 3> bands{};   ///< maximum error of each evaluated line
  double least_sum = 0;            ///< double suffices for smooth values if Σ E_i is above this
  bool affine_is_certain = false;  ///< true if double suffices for values linear in the window
  bool depth_is_certain = false;
};

/// How the coverage of the sample was decided.
enum class Decision {
  outside,           ///< outside the viewport, the scissor, or the triangle's bounding box
  in_double,         ///< farther from every edge than the error of double
  exactly,           ///< by a sum without rounding, or the fill rule
  in_whole_numbers,  ///< in integers, on the subpixel grid
  clipped,           ///< inside the edges but beyond a clip plane
  by_span,  ///< between the ends of its row's span (rasterizer/methods/internal/convex_scan.h)
};

/// How an attribute or depth was computed: from planes, from the trace's lines, or from neither (a
/// copy, a sum without rounding, or a method's own formula).
struct TracedValue {
  double u = 0;  ///< where it was evaluated, in pixels
  double v = 0;
  /// True if the value comes from the original clip positions rather than `corners` and `snapped`.
  bool is_from_vertices = false;
  /// The corners that the value comes from, if they belong to another part than the sample does.
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// The value is numerator / denominator, or only the numerator. `…_at` holds their values at
  /// (u, v).
  std::optional<TracedPlane> numerator = std::nullopt;
  std::optional<TracedPlane> denominator = std::nullopt;
  std::optional<double> numerator_at = std::nullopt;
  std::optional<double> denominator_at = std::nullopt;
  bool is_from_lines = false;
  /// If `is_from_lines`: either the lines at (u, v) or, in float32, the corners' shares in the
  /// value Σ share_c r_c / Σ share_c.
  std::optional<std::array<double, 3>> weights = std::nullopt;
  std::optional<std::array<double, 3>> shares = std::nullopt;
  bool is_exact = false;  ///< from sums without rounding, because double did not suffice
  /// The value before it was rounded to float32; empty if it was computed in float32.
  std::optional<double> evaluated = std::nullopt;
  float value = 0;
};

struct Trace {
  bool is_drawn = false;                 ///< if false, the trace has no values
  std::array<glm::vec4, 3> positions{};  ///< as the draw received them, in clip space
  /// For a clipped triangle, the corners, before snapping, of the part that the sample lies in;
  /// those that are vertices are rounded to double. For a method, the window coordinates that it
  /// computed for the vertices.
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  /// With snapping, the same corners on the grid; these decide coverage.
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// The coordinates U, V and T, and the lines E_i of the part's corners or (Basis::ideal) of the
  /// clip positions.
  std::optional<TracedFrame> frame = std::nullopt;
  std::optional<std::array<TracedPlane, 3>> lines = std::nullopt;
  std::optional<TracedCertificate> certificate = std::nullopt;
  double u = 0;  ///< assumed location of the sample, in pixels
  double v = 0;
  std::optional<std::array<double, 3>> edges = std::nullopt;  ///< E_i at (u, v)
  Decision decision = Decision::outside;
  TracedValue depth;
  std::vector<TracedValue> attributes;
};

struct TraceResult {
  std::optional<Error> error;
  /// Empty if the triangle was not set up (culled, hidden, without area, not finite) or the sample
  /// lies outside the target.
  std::optional<Trace> trace;
};

/// Draws one triangle as draw_fragments does and traces one of its samples, drawn or not. Returns
/// Error::index if the mesh does not have the triangle.
TraceResult trace_sample(const State& state, const Mesh& mesh, const TargetSize& size,
                         const SamplePlace& address);

}  // namespace rastercheck::rasterizer
