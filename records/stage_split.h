#pragma once

// An error split into parts by the stage that caused each, as plain data.
//
// Let V_0 be the exact value, and V_k the value that exact arithmetic gets from the actual output
// of stage k, with all later stages unrounded. The part of stage k is V_k − V_(k−1). The last V is
// the drawn value, so the parts add up to the error exactly.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "cases/names.h"
#include "records/enclosure.h"

namespace rastercheck::records {

enum class Stage {
  transform,   ///< object positions to clip positions, float32
  clip_space,  ///< division by w and viewport, or clipping to new corners
  snap,        ///< window positions to the subpixel grid
  set_up,      ///< lines or planes of the triangle
  coverage,    ///< which samples are covered, and where their values are evaluated
  weights,     ///< the lines or planes at one place
  evaluation,  ///< the value from the weights
  rounding,    ///< rounding to float32
  // In addition to `transform`, used for backends that do not report their stages:
  left_open,  ///< the part that the contract leaves open, e.g. snapping
  excess,     ///< the rest of the error
  // Depths only: `bias` comes before set_up, and `store` takes the place of `rounding`.
  bias,   ///< what a depth bias adds to depths, computed from the corners
  store,  ///< storing a depth in a unorm format, all rounding included
};
constexpr auto names_of(Stage /*type*/) {
  return std::to_array<std::string_view>({"transform", "clip space", "snap", "set-up", "coverage",
                                          "weights", "evaluation", "rounding", "left open",
                                          "excess", "bias", "store"});
}
constexpr std::string_view to_string(Stage stage) { return cases::name_of(stage); }

struct StagePart {
  Stage stage = Stage::transform;
  Enclosure error;  ///< signed, in scale ULP
  bool operator==(const StagePart&) const = default;
};

/// The error of one value of one sample.
struct ErrorSplit {
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; empty for depth
  /// The parts in the order of the stages, each stage at most once. Omits stages that the backend
  /// lacks or cannot separate from the next.
  std::vector<StagePart> parts;
  Enclosure total;         ///< signed, in scale ULP: the sum of the parts
  bool is_traced = false;  ///< true if computed from a trace, false if only from what every backend
                           ///< provides
  bool operator==(const ErrorSplit&) const = default;
};

/// The stage of the part with the largest magnitude; the first such stage if several are equal;
/// empty if all parts are 0.
std::optional<Stage> largest_part(const ErrorSplit& split);

}  // namespace rastercheck::records
