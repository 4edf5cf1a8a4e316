#pragma once

// An error split by the stages that made it, as plain data.
//
// Let V_0 be the exact value, and V_k what exact arithmetic makes of what stage k really handed on:
// all later stages without rounding. The part of stage k is V_k − V_(k−1), and the last V is the
// drawn value, so that the parts add up to the error exactly.

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
  clip_space,  ///< dividing and viewport, or clipping to new corners
  snap,        ///< window positions to the subpixel grid
  set_up,      ///< lines or planes of the triangle
  coverage,    ///< which samples, and where their values are evaluated
  weights,     ///< the lines or planes at one place
  evaluation,  ///< the value from them
  rounding,    ///< to float32
  // Of backends that do not tell how they draw, besides `transform`:
  left_open,  ///< what the contract leaves open: snapping, say
  excess,     ///< what is beyond that
};
constexpr auto names_of(Stage /*type*/) {
  return std::to_array<std::string_view>({"transform", "clip space", "snap", "set-up", "coverage",
                                          "weights", "evaluation", "rounding", "left open",
                                          "excess"});
}
constexpr std::string_view to_string(Stage stage) { return cases::name_of(stage); }

struct StagePart {
  Stage stage = Stage::transform;
  Enclosure error;  ///< signed, in scale ULP
  bool operator==(const StagePart&) const = default;
};

/// The error of one value of one sample.
struct ErrorSplit {
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; nothing for depth
  /// In the order of the stages; each at most once. Stages that the backend does not have, or
  /// cannot tell apart from the next, are left out.
  std::vector<StagePart> parts;
  Enclosure total;         ///< signed, in scale ULP: the sum of the parts
  bool is_traced = false;  ///< from a trace, else only what any backend shows
  bool operator==(const ErrorSplit&) const = default;
};

/// The part of largest magnitude, the first of equally large ones; nothing where all are 0.
std::optional<Stage> largest_part(const ErrorSplit& split);

}  // namespace rastercheck::records
