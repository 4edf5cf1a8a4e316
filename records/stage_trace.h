#pragma once

// How one sample of a drawing came about, stage by stage, as plain data: what a backend that can
// tell says of itself (backends/backend.h). What a stage handed on is there where there is such a
// stage and the backend tells it. Numbers are those that it computed with, to the bit.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rastercheck::records {

/// A corner of what is drawn of a triangle: a vertex, or one that clipping made.
struct TracedCorner {
  double x = 0;  ///< window position, pixels; where `is_homogeneous` times w
  double y = 0;
  double z = 0;  ///< of the clip volume, times w
  double w = 0;
  bool is_homogeneous = false;
  /// How much of each vertex is in it: r = Σ share_v r_v, and so r w, z and w.
  std::array<double, 3> share{};
  bool operator==(const TracedCorner&) const = default;
};

/// Lines and planes are functions of (U, V) = scale · (2 (u, v) − shift), (u, v) in pixels.
struct TracedAxis {
  double scale = 0;
  double shift = 0;
  bool operator==(const TracedAxis&) const = default;
};
struct TracedFrame {
  TracedAxis u;
  TracedAxis v;
  double t = 0;
  bool operator==(const TracedFrame&) const = default;
};

/// E_i = a U + (b V + c T) of a corner, a positive multiple of e_i (RULES §1), the same for all
/// three. In the order in which it is evaluated, each operation rounded to double.
struct TracedLine {
  double a = 0;
  double b = 0;
  double c = 0;
  bool operator==(const TracedLine&) const = default;
};

/// a U + (b V + c), likewise.
struct TracedPlane {
  double a = 0;
  double b = 0;
  double c = 0;
  bool operator==(const TracedPlane&) const = default;
};

/// How depth or an attribute came about. What a stage handed on is there where the value comes from
/// that; what was computed beside it is not. A value with neither planes nor lines nor weights was
/// copied, comes from sums without rounding, or in a way that the backend does not tell.
struct TracedValue {
  double u = 0;  ///< where it was evaluated, pixels
  double v = 0;
  /// Whether it belongs to the clip positions as they are: `corners` and `snapped` of the trace are
  /// what is covered, and no part of how the value came about.
  bool is_from_vertices = false;
  /// The stages `clip_space` and `snap` of the part that it is of, where that is another than the
  /// sample's: of a value at the centre, say.
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// The stage `set_up`: the value is numerator / denominator, or the numerator alone.
  std::optional<TracedPlane> numerator = std::nullopt;
  std::optional<TracedPlane> denominator = std::nullopt;
  /// Or it comes from SampleTrace::lines.
  bool is_from_lines = false;
  /// The stage `weights`: these planes at (u, v), depth before it is held to its range.
  std::optional<double> numerator_at = std::nullopt;
  std::optional<double> denominator_at = std::nullopt;
  /// Or a multiple of the weights of the corners there; where it is from lines, E_i.
  std::optional<std::array<double, 3>> weights = std::nullopt;
  /// Or a multiple of the shares of the corners in the value, of whatever interpolation: it is
  /// Σ share_c r_c / Σ share_c.
  std::optional<std::array<double, 3>> shares = std::nullopt;
  bool is_exact = false;  ///< from sums without rounding
  /// The stage `evaluation`: before it was rounded to float32; nothing where that was the last
  /// operation.
  std::optional<double> evaluated = std::nullopt;
  float value = 0;
  bool operator==(const TracedValue&) const = default;
};

struct SampleTrace {
  bool is_drawn = true;  ///< else there are no values
  /// The stage `transform`: the clip positions (x, y, z, w) that were received.
  std::array<std::array<float, 4>, 3> positions{};
  /// The stage `clip_space`, where there is one: the corners of the part that the sample is of.
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  /// The stage `snap`, where there is one: the same on the grid.
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// The stage `set_up`: of those corners, or of the vertices where there are none or values are
  /// `is_from_vertices`.
  std::optional<TracedFrame> frame = std::nullopt;
  std::optional<std::array<TracedLine, 3>> lines = std::nullopt;
  /// The stage `coverage`: where the sample was taken to be, pixels, E_i there as they were
  /// computed, and how it was decided.
  double u = 0;
  double v = 0;
  std::optional<std::array<double, 3>> edges = std::nullopt;
  std::string decision = {};
  TracedValue depth = {};
  std::vector<TracedValue> attributes = {};
  bool operator==(const SampleTrace&) const = default;
};

}  // namespace rastercheck::records
