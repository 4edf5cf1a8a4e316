#pragma once

// The textbook methods, one file each. A file in rasterizer/methods/ defines one, or a few that
// differ in a step, and registers it:
//
//   const MethodRegistration kRegistration({.name = "my-method",
//                                           .source = "seed and section",
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

/// Appends the fragments of every triangle, as if each were drawn alone, and shows a tap, unless it
/// is nullptr, how. The arguments were checked.
using DrawFragments = DrawCounts (*)(const State& state, const Mesh& mesh, const TargetSize& size,
                                     Fragments& fragments, MethodTap* tap);

/// What a method means smooth values to be: linear in clip space, or, of one that never divides,
/// linear in window space, as noperspective ones are.
enum class Claim { perspective, affine };

/// How a method finds out what is covered.
enum class ScanKind {
  /// By draw_fragments, exactly; depth, noperspective and flat values are its own, too.
  exact,
  /// By clipping and scan conversion in double (internal/clip_polygon.h, internal/convex_scan.h),
  /// which is wrong only close to an edge.
  scanned,
};

/// How far values may be off what is claimed, in scale ULP (rasterizer.h: kValueBound):
///
///   constant + per_horizon · g + per_condition · K + range_share · (max r_i − min r_i)/ulp
///
/// g = the greatest 1/w of what is drawn of the triangle / 1/w; 1 of what is linear in the window.
/// K says how much of its digits a weight loses that is evaluated as a plane; internal/
/// point_drawing.h defines it. Nothing is promised where per_condition · K reaches 2^24.
/// `range_share` is what a method is off by because it approximates; of a method whose claim is
/// Claim::perspective.
struct MethodBound {
  double constant = 0.5;
  double per_horizon = 0;
  double per_condition = 0;
  double range_share = 0;
};

/// What a method promises of one draw.
struct Promise {
  Claim claims = Claim::perspective;
  ScanKind scan = ScanKind::exact;
  MethodBound smooth = {};
  /// Only of ScanKind::scanned; otherwise it is draw_fragments' own. There is no per_condition and
  /// no range_share in it.
  MethodBound noperspective = {};
};

/// Arithmetic operations; a comparison or a change of sign is none.
struct Operations {
  std::size_t additions = 0;  ///< and subtractions
  std::size_t multiplications = 0;
  std::size_t divisions = 0;
  bool operator==(const Operations&) const = default;

  std::size_t total() const { return additions + multiplications + divisions; }
};

/// What a method costs with two attributes, besides the transform to window coordinates and what
/// finds out which samples are covered: counted by running it on a triangle with numbers that
/// count.
struct OperationCounts {
  Operations per_polygon;  ///< once for each triangle
  Operations per_vertex;
  Operations per_row;  ///< both edges of a row of samples
  Operations per_pixel;
};

struct Method {
  std::string_view name;    ///< as in `method:NAME`
  std::string_view source;  ///< the text it comes from: seed and section
  std::string_view fails;   ///< where: "in perspective", or "at the end of long rows"
  DrawFragments draw = nullptr;
  Promise (*promise)(const State& state, const Mesh& mesh, const TargetSize& size) = nullptr;
  OperationCounts (*operations)() = nullptr;
  /// Of what scan-converts polygons (polygon.h): draws the mesh's vertices in their order as one,
  /// triangle 0, once they were checked.
  DrawFragments draw_polygon = nullptr;
};

/// All methods, in the order of their names.
std::span<const Method> methods();
/// The method of a name; nullptr where there is none.
const Method* find_method(std::string_view name);

/// draw_fragments by a textbook method; Error::unknown_method where there is none of that name.
DrawResult draw_fragments_by(std::string_view method, const State& state, const Mesh& mesh,
                             const TargetSize& size, Fragments& fragments);

/// trace_sample of a textbook method: what those of a kind have in common, and of a smooth value
/// what its formula made before that was rounded.
TraceResult trace_sample_by(std::string_view method, const State& state, const Mesh& mesh,
                            const TargetSize& size, const SamplePlace& address);

struct MethodRegistration {
  explicit MethodRegistration(const Method& method);
};

}  // namespace rastercheck::rasterizer
