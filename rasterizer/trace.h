#pragma once

// How one sample of a draw came about, stage by stage: for reports that split an error by stages,
// and for whoever asks why. What a stage handed on is there where there is such a stage, and
// otherwise not. Numbers are those that the drawing computed with, to the bit.

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A sample of a triangle.
struct SamplePlace {
  std::uint32_t triangle = 0;
  int x = 0;
  int y = 0;
  int sample = 0;
};

/// A corner of what is drawn of a triangle: a vertex, or one that clipping made.
struct TracedCorner {
  double x = 0;  ///< window position, pixels; where `is_homogeneous` times w
  double y = 0;
  double z = 0;  ///< of clip space, as w
  double w = 0;
  bool is_homogeneous = false;
  /// How much of each vertex is in it, r = Σ share_v r_v.
  std::array<double, 3> share{};
};

/// A window coordinate for lines and planes: scale · (2 at − shift), `at` in pixels.
struct TracedAxis {
  double scale = 0;
  double shift = 0;
};
struct TracedFrame {
  TracedAxis u;
  TracedAxis v;
  double t = 0;
};

/// a U + (b V + c), each operation rounded to double; of a line a U + (b V + c T).
struct TracedPlane {
  double a = 0;
  double b = 0;
  double c = 0;
};

/// What double knows of the weights (rasterizer/internal/certificates.h).
struct TracedCertificate {
  std::array<double, 3> bands{};   ///< how far an evaluated line may be off
  double least_sum = 0;            ///< Σ E_i from which on double is enough for smooth values
  bool affine_is_certain = false;  ///< whether it is for values that are linear in the window
  bool depth_is_certain = false;
};

/// How it was found out whether a sample is covered.
enum class Decision {
  outside,           ///< beyond viewport, scissor, or the box that the triangle touches
  in_double,         ///< farther from every edge than double is off
  exactly,           ///< by a sum without rounding, or the fill rule
  in_whole_numbers,  ///< on the subpixel grid
  clipped,           ///< inside the edges, and beyond a clip plane
  by_span,  ///< between the ends of its row's span (rasterizer/methods/internal/convex_scan.h)
};

/// An attribute, or depth. It comes from planes, from the lines of the trace, or from neither: then
/// it is copied, comes from sums without rounding, or from the formula of a method.
struct TracedValue {
  double u = 0;  ///< where it was evaluated, pixels
  double v = 0;
  /// Whether it belongs to the clip positions as they are, past `corners` and `snapped`.
  bool is_from_vertices = false;
  /// The corners that it comes from, where they are of another part than the sample's.
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// The value is numerator / denominator, or the numerator alone, and both at (u, v) are these.
  std::optional<TracedPlane> numerator = std::nullopt;
  std::optional<TracedPlane> denominator = std::nullopt;
  std::optional<double> numerator_at = std::nullopt;
  std::optional<double> denominator_at = std::nullopt;
  bool is_from_lines = false;
  /// Of such a value the lines at (u, v), or, in float32, the shares of the corners in it, which
  /// belong to Σ share_c r_c / Σ share_c.
  std::optional<std::array<double, 3>> weights = std::nullopt;
  std::optional<std::array<double, 3>> shares = std::nullopt;
  bool is_exact = false;  ///< from sums without rounding, as double was not enough
  /// Before it was rounded to float32; nothing where that was the last operation.
  std::optional<double> evaluated = std::nullopt;
  float value = 0;
};

struct Trace {
  bool is_drawn = false;                 ///< else there are no values
  std::array<glm::vec4, 3> positions{};  ///< received, clip space
  /// Of a triangle that is clipped the corners of the part that the sample is of, before they were
  /// snapped: vertices among them rounded to double. Of a method its window coordinates of the
  /// vertices.
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  /// Where vertices are snapped the same on the grid: what is covered comes from them.
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// E_i of the part's corners, or of the clip positions (Basis::ideal).
  std::optional<TracedFrame> frame = std::nullopt;
  std::optional<std::array<TracedPlane, 3>> lines = std::nullopt;
  std::optional<TracedCertificate> certificate = std::nullopt;
  double u = 0;  ///< where the sample was taken to be, pixels
  double v = 0;
  std::optional<std::array<double, 3>> edges = std::nullopt;  ///< E_i there
  Decision decision = Decision::outside;
  TracedValue depth;
  std::vector<TracedValue> attributes;
};

struct TraceResult {
  std::optional<Error> error;
  /// Nothing where the triangle was not set up (culled, hidden, without area, not finite), or the
  /// sample is not of the target.
  std::optional<Trace> trace;
};

/// Draws one triangle as draw_fragments does and says how a sample of it came about, or that it is
/// not drawn. A triangle that the mesh does not have is Error::index.
TraceResult trace_sample(const State& state, const Mesh& mesh, const TargetSize& size,
                         const SamplePlace& address);

}  // namespace rastercheck::rasterizer
