#pragma once

// The error of a drawn value split by the stages that made it (records/stage_split.h), in exact
// numbers throughout.
//
// V_0 is the value of the exact triangle as the case was given: of a case with a camera that of its
// object positions, whatever the contract leaves open and wherever vertices are snapped to. V_k is
// what exact arithmetic makes of what stage k handed on, at the place that the rules name until the
// stage `coverage` has named the one that was taken:
//
//   transform   the clip positions that were received
//   clip_space  the corners            M = columns (x w, y w, w), e = M^-1 (u, v, 1)
//   snap        the snapped corners    the same
//   set_up      lines                  E_i as they are, in place of e_i
//               planes                 numerator / denominator
//   coverage    the last of these at the place where the value was evaluated
//   weights     numerator and denominator, or E_i, or the corners' shares in the value, as they
//               were computed there
//   evaluation  the value before it was rounded; where that was the last operation, the drawn one
//   rounding    the drawn value
//
// With corners c, whose shares of the vertices v make r_c = Σ share r_v and (r w)_c = Σ share r_v
// w_v, a smooth value is Σ r_c E_c / Σ E_c, a noperspective one Σ (r w)_c E_c / Σ w_c E_c, and z/w
// of the depth Σ z_c E_c / Σ w_c E_c: a common factor of E_c has no say. Depths are clamped where
// the rules clamp them. A stage after which there is no value (its denominator is 0, or a number is
// not finite) is left out, and its part falls to the next.
//
// Where OpenGL and Vulkan let a centroid be anywhere in pixel and triangle, the place that was
// taken is the right one if it is there; if it is not, the one D3D names is.

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

/// A split before it is rounded to doubles; errors are in the value's own unit.
struct ExactSplit {
  struct Part {
    records::Stage stage = records::Stage::transform;
    Rational error;
  };

  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; nothing for depth
  Rational exact;                          ///< V_0
  Rational unit;                           ///< a scale ULP (oracle/ulp.h)
  std::vector<Part> parts;                 ///< in the order of the stages, each at most once
  bool is_traced = false;
};

/// Whether the parts add up to actual − exact, without rounding. `actual` is finite.
bool adds_up(const ExactSplit& split, float actual);

/// In scale ULP: doubles around each, equal where a double holds it.
records::ErrorSplit enclose(const ExactSplit& split);

/// One triangle of a case, for all questions about its errors.
class StageSplit {
 public:
  /// `given` is the case with its camera, if it has one; `drawn` what the backend was handed of it
  /// (oracle/transform.h). `triangle` is an index into the triangles of both.
  StageSplit(const cases::Case& given, const cases::Case& drawn, const cases::Contract& contract,
             std::uint32_t triangle);
  ~StageSplit();

  /// What makes the triangle's fragments hard.
  records::Stratum stratum() const;

  /// By what the backend tells of the sample: of an attribute, or of the depth where `attribute` is
  /// nothing. Nothing of a value that is no finite number, that the rules leave undefined, or that
  /// is not, to the bit, the one that the trace is about.
  std::optional<ExactSplit> traced(std::optional<std::uint32_t> attribute, std::uint32_t x,
                                   std::uint32_t y, std::uint32_t sample, float actual,
                                   const records::SampleTrace& trace) const;

  /// By what can be seen of any backend: `transform`, the rounding of the clip positions; what the
  /// contract leaves open, up to the end of its range, or all of it where the value is in the
  /// range; and the excess beyond. Nothing of a value that is no finite number or that the rules
  /// leave undefined.
  std::optional<ExactSplit> untraced(std::optional<std::uint32_t> attribute, std::uint32_t x,
                                     std::uint32_t y, std::uint32_t sample, float actual) const;

  /// Of a sample that is missing or extra by the contract: the first stage whose exact continuation
  /// says otherwise than the rules do. `coverage` decides from what all others handed on, so that
  /// clip planes and distances that it reads off them, viewport, scissor and culling are its own; a
  /// triangle without a trace was not drawn by its decision. Nothing where the sample is neither,
  /// where the trace is of another drawing, and of a missing sample of a triangle that was cut,
  /// whose corners tell of one of its parts only.
  std::optional<records::Stage> coverage_stage(std::uint32_t x, std::uint32_t y,
                                               std::uint32_t sample, bool is_drawn,
                                               const records::SampleTrace* trace) const;

 private:
  struct Triangles;
  std::unique_ptr<const Triangles> triangles_;
};

}  // namespace rastercheck::oracle
