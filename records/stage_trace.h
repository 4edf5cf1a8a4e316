#pragma once

// How a backend computed one sample, stage by stage, as plain data. Backends that can trace their
// stages report it (backends/backend.h). A stage's output is present if the backend has that stage
// and reports it. Numbers are exactly those the backend computed with.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rastercheck::records {

/// A corner of the drawn part of a triangle: a vertex, or a corner made by clipping.
struct TracedCorner {
  double x = 0;  ///< window position, pixels; times w if `is_homogeneous`
  double y = 0;
  double z = 0;  ///< position in the clip volume, times w
  double w = 0;
  bool is_homogeneous = false;
  /// The share of each vertex in this corner: r = Σ share_v r_v, and likewise r w, z and w.
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

/// E_i = a U + (b V + c T) for a corner: a positive multiple of e_i (RULES §1), with the same
/// factor for all three. Evaluated in this order, each operation rounded to double.
struct TracedLine {
  double a = 0;
  double b = 0;
  double c = 0;
  bool operator==(const TracedLine&) const = default;
};

/// a U + (b V + c), evaluated in this order, each operation rounded to double.
struct TracedPlane {
  double a = 0;
  double b = 0;
  double c = 0;
  bool operator==(const TracedPlane&) const = default;
};

/// How depth or an attribute was computed. A stage's output is present only if the value comes from
/// it, not if it was merely computed as well. A value without planes, lines and weights was copied,
/// comes from sums without rounding, or was computed in a way that the backend does not report.
struct TracedValue {
  double u = 0;  ///< the place where the value was evaluated, pixels
  double v = 0;
  /// True if the value comes from the unmodified clip positions; the trace's `corners` and
  /// `snapped` then decided coverage only.
  bool is_from_vertices = false;
  /// The stages `clip_space` and `snap` of the part of the triangle that the value comes from, if
  /// that is not the part with the sample (for a value at the centre, say).
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// The stage `set_up`: the value is numerator / denominator, or the numerator alone.
  std::optional<TracedPlane> numerator = std::nullopt;
  std::optional<TracedPlane> denominator = std::nullopt;
  /// Alternatively, the value comes from SampleTrace::lines.
  bool is_from_lines = false;
  /// The stage `weights`: these planes at (u, v); depth before clamping to its range.
  std::optional<double> numerator_at = std::nullopt;
  std::optional<double> denominator_at = std::nullopt;
  /// Alternatively, a multiple of the corners' weights at (u, v); E_i if `is_from_lines`.
  std::optional<std::array<double, 3>> weights = std::nullopt;
  /// Alternatively, a multiple of the corners' shares in the value, for any interpolation: the
  /// value is Σ share_c r_c / Σ share_c.
  std::optional<std::array<double, 3>> shares = std::nullopt;
  bool is_exact = false;  ///< true if the value comes from sums without rounding
  /// The stage `evaluation`: the value before rounding to float32; empty if that rounding was part
  /// of the last operation.
  std::optional<double> evaluated = std::nullopt;
  float value = 0;
  bool operator==(const TracedValue&) const = default;
};

struct SampleTrace {
  bool is_drawn = true;  ///< if false, no values are present
  /// The stage `transform`: the clip positions (x, y, z, w) that were received.
  std::array<std::array<float, 4>, 3> positions{};
  /// The stage `clip_space`, if any: the corners of the part that contains the sample.
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  /// The stage `snap`, if any: those corners on the grid.
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// The stage `set_up`: lines computed from those corners. They are computed from the vertices if
  /// the trace has no corners, or for values with `is_from_vertices`.
  std::optional<TracedFrame> frame = std::nullopt;
  std::optional<std::array<TracedLine, 3>> lines = std::nullopt;
  /// The stage `coverage`: the assumed position of the sample, pixels, E_i as computed there, and
  /// how coverage was decided.
  double u = 0;
  double v = 0;
  std::optional<std::array<double, 3>> edges = std::nullopt;
  std::string decision = {};
  TracedValue depth = {};
  std::vector<TracedValue> attributes = {};
  bool operator==(const SampleTrace&) const = default;
};

}  // namespace rastercheck::records
