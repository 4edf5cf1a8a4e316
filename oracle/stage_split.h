#pragma once

// Splits the error of a drawn value by the stages that caused it (records/stage_split.h), in exact
// numbers throughout.
//
// V_0 is the value of the exact triangle as the case was given: from object positions if it has a
// camera, ignoring snapping and everything the contract leaves open. V_k is the value that exact
// arithmetic makes of the output of stage k, at the place that the rules name; from the stage
// `coverage` on, at the place that the backend took.
//
//   transform   the clip positions that were received
//   clip_space  the corners            M = columns (x w, y w, w), e = M^-1 (u, v, 1)
//   snap        the snapped corners    the same
//   bias        the same corners       their own depth bias instead of the given triangle's
//   set_up      lines                  the traced E_i are used in place of e_i
//               planes                 numerator / denominator
//   coverage    the form of the last stage above, at the place where the value was evaluated
//   weights     numerator and denominator, or E_i, or the corners' shares in the value, as computed
//               at that place
//   evaluation  the traced value before rounding or, if the trace has none, the drawn value
//   rounding    the drawn value; `store` if a depth is stored in a unorm format
//
// Let corner c be the mix of vertices v with weights share_cv: r_c = Σ share_cv r_v and (r w)_c = Σ
// share_cv r_v w_v. A smooth value is Σ r_c E_c / Σ E_c, a noperspective one Σ (r w)_c E_c / Σ w_c
// E_c, and z/w of the depth Σ z_c E_c / Σ w_c E_c: a common factor of E_c cancels. Depths are
// clamped where the rules clamp them. A stage whose output gives no value (a zero denominator, or a
// number that is not finite) is left out; its error counts for the next stage.
//
// OpenGL and Vulkan let a centroid be anywhere in the pixel and the triangle. If the backend took a
// place there, that place is the right one; otherwise the right place is the one that D3D names.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "oracle/rational.h"
#include "records/judgement.h"
#include "records/stage_split.h"
#include "records/stage_trace.h"

namespace rastercheck::oracle {

/// A split before rounding to doubles; errors are in the value's own unit.
struct ExactSplit {
  struct Part {
    records::Stage stage = records::Stage::transform;
    Rational error;
  };

  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; empty for depth
  Rational exact;                          ///< V_0
  Rational unit;                           ///< a scale ULP (oracle/ulp.h)
  std::vector<Part> parts;                 ///< in the order of the stages, each at most once
  bool is_traced = false;
};

/// True if the parts sum exactly to actual − exact. `actual` must be finite.
bool adds_up(const ExactSplit& split, float actual);

/// Converts a split to scale ULP. Each part becomes the closest doubles around it, which are equal
/// if a double holds the part exactly.
records::ErrorSplit enclose(const ExactSplit& split);

/// One triangle of a case, set up for all questions about its errors.
class StageSplit {
 public:
  /// `given` is the case with its camera, if any; `drawn` the clip-space case that the backend
  /// received (oracle/transform.h). `triangle` is an index into the triangles of both.
  StageSplit(const cases::Case& given, const cases::Case& drawn, const cases::Contract& contract,
             std::uint32_t triangle);
  ~StageSplit();

  /// The property that makes the triangle's fragments hard.
  records::Stratum stratum() const;

  /// Splits the error of an attribute, or of the depth if `attribute` is empty, by the backend's
  /// trace of the sample. Empty if the value is not finite, if the rules leave the value undefined,
  /// or if the value is not bit for bit the one traced.
  std::optional<ExactSplit> traced(std::optional<std::uint32_t> attribute, std::uint32_t x,
                                   std::uint32_t y, std::uint32_t sample, float actual,
                                   const records::SampleTrace& trace) const;

  /// Splits the error without a trace, for any backend: `transform` is the rounding of the clip
  /// positions; then the part that the contract leaves open (up to the end of its range, or all if
  /// the value is in the range); then the excess. Empty if the value is not finite or undefined.
  std::optional<ExactSplit> untraced(std::optional<std::uint32_t> attribute, std::uint32_t x,
                                     std::uint32_t y, std::uint32_t sample, float actual) const;

  /// The stage at fault for a sample that is missing or extra by the contract: the first stage
  /// whose output, continued exactly, contradicts the rules. `coverage` decides from the outputs of
  /// all other stages, so faults of clip planes and clip distances (computed from these outputs),
  /// viewport, scissor and culling are its faults; a triangle without a trace was dropped by
  /// `coverage`. Empty if the sample is neither missing nor extra, if the trace belongs to another
  /// drawing, and for a missing sample of a clipped triangle, because the traced corners describe
  /// only one of the triangle's pieces.
  std::optional<records::Stage> coverage_stage(std::uint32_t x, std::uint32_t y,
                                               std::uint32_t sample, bool is_drawn,
                                               const records::SampleTrace* trace) const;

 private:
  struct Triangles;
  std::unique_ptr<const Triangles> triangles_;
};

}  // namespace rastercheck::oracle
