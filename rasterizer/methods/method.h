#pragma once

// The textbook methods, one file each. Each file in rasterizer/methods/ defines one method, or a
// few that differ in a step, and registers them:
//
//   const MethodRegistration kRegistration({.name = "my-method",
//                                           .source = "text and section",
//                                           .draw = &draw,
//                                           .promise = &promise,
//                                           .operations = &operations});

#include <cstddef>
#include <span>
#include <string_view>

#include "rasterizer/rasterizer.h"
#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

class MethodTap;

/// Appends the fragments of every triangle, each drawn as if alone. `tap`, unless nullptr, records
/// how one sample is drawn. The arguments must have been checked.
using DrawFragments = DrawCounts (*)(const State& state, const Mesh& mesh, const TargetSize& size,
                                     Fragments& fragments, MethodTap* tap);

/// A method's claim about smooth values: they are linear in clip space or, for a method that
/// never divides, linear in window space like noperspective values.
enum class Claim { perspective, affine };

/// How a method decides coverage.
enum class ScanKind {
  /// Exactly, by draw_fragments, which also computes depth, noperspective and flat values.
  exact,
  /// By clipping and scan conversion in double (internal/clip_polygon.h, internal/convex_scan.h),
  /// which can be wrong only close to an edge.
  scanned,
};

/// Maximum deviation of values from the claim, in scale ULP (rasterizer.h: kValueBound):
///
///   constant + per_horizon · g + per_condition · K + range_share · (max r_i − min r_i)/ulp
///
/// g = (greatest 1/w in the drawn part of the triangle) / (1/w); 1 for values linear in the window.
/// K measures how many digits a weight loses when evaluated as a plane; internal/point_drawing.h
/// defines it. Nothing is promised if per_condition · K reaches 2^24. `range_share` is a method's
/// approximation error; it occurs only with Claim::perspective.
struct MethodBound {
  double constant = 0.5;
  double per_horizon = 0;
  double per_condition = 0;
  double range_share = 0;
};

/// A method's promise for one draw.
struct Promise {
  Claim claims = Claim::perspective;
  ScanKind scan = ScanKind::exact;
  MethodBound smooth = {};
  /// Used only with ScanKind::scanned; otherwise draw_fragments' own bound holds. Its per_condition
  /// and range_share are 0.
  MethodBound noperspective = {};
};

/// Counts of arithmetic operations; comparisons and changes of sign do not count.
struct Operations {
  std::size_t additions = 0;  ///< additions and subtractions
  std::size_t multiplications = 0;
  std::size_t divisions = 0;
  bool operator==(const Operations&) const = default;

  std::size_t total() const { return additions + multiplications + divisions; }
};

/// A method's cost with two attributes, without the transform to window coordinates and without
/// deciding coverage. Counted by running the method on a triangle of counting numbers (counted.h).
struct OperationCounts {
  Operations per_polygon;  ///< once for each triangle
  Operations per_vertex;
  Operations per_row;  ///< both edges of a row of samples
  Operations per_pixel;
};

struct Method {
  std::string_view name;    ///< as in `method:NAME`
  std::string_view source;  ///< the text that describes it, with section
  std::string_view fails;   ///< where it fails: "in perspective", or "at the end of long rows"
  DrawFragments draw = nullptr;
  Promise (*promise)(const State& state, const Mesh& mesh, const TargetSize& size) = nullptr;
  OperationCounts (*operations)() = nullptr;
  /// Only for methods that scan-convert polygons (polygon.h): draws the mesh's vertices, in order,
  /// as one polygon, triangle 0. The arguments must have been checked.
  DrawFragments draw_polygon = nullptr;
};

/// All methods, ordered by name.
std::span<const Method> methods();
/// Returns the method of this name; nullptr if no method has the name.
const Method* find_method(std::string_view name);

/// Like draw_fragments, but by a textbook method. Returns Error::unknown_method if no method has
/// the name.
DrawResult draw_fragments_by(std::string_view method, const State& state, const Mesh& mesh,
                             const TargetSize& size, Fragments& fragments);

/// Like trace_sample, but for a textbook method. The trace has the stages common to methods of its
/// kind and, for a smooth value, the formula's result before rounding.
TraceResult trace_sample_by(std::string_view method, const State& state, const Mesh& mesh,
                            const TargetSize& size, const SamplePlace& address);

struct MethodRegistration {
  explicit MethodRegistration(const Method& method);
};

}  // namespace rastercheck::rasterizer
