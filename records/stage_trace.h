#pragma once

// How one sample of a drawing came about, stage by stage, as plain data: what a backend that can
// tell says of itself (backends/backend.h).
//
//   stage        received                  handed on
//   edges        x0 y0 z0 w0 … w2          a0 b0 c0 band0 … band2, is_snapped
//   certificate  band0 band1 band2         least_sum, affine_is_certain, depth_is_certain
//   coverage     U V T                     in_double, exactly or in_whole_numbers, which is 1
//   weights      U V T                     E0 E1 E2
//   evaluation   E0 E1 E2                  depth, depth_is_exact, and of attribute number a: r[a],
//                                          r[a]_is_exact, and r[a]_u and r[a]_v where that is not
//                                          at the sample
//
// A weight is E_i = a_i U + (b_i V + c_i T), each operation rounded to double; band_i is how far it
// may be off. Whether something is so is 1 or 0. Numbers are doubles; a float32 is one, to the bit.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::records {

/// A sample of a triangle.
struct SampleAddress {
  std::uint32_t triangle = 0;  ///< index into the case's triangles
  std::uint32_t x = 0;         ///< pixels
  std::uint32_t y = 0;         ///< pixels
  std::uint32_t sample = 0;    ///< index into the sample pattern
  bool operator==(const SampleAddress&) const = default;
};

struct NamedNumber {
  std::string name;
  double value = 0;
  bool operator==(const NamedNumber&) const = default;
};
using NamedNumbers = std::vector<NamedNumber>;

struct StageTrace {
  std::string stage;
  NamedNumbers received;
  NamedNumbers handed_on;
  bool operator==(const StageTrace&) const = default;
};

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

/// E_i = a U + b V + c T of a corner, a positive multiple of e_i (RULES §1), the same for all
/// three.
struct TracedLine {
  double a = 0;
  double b = 0;
  double c = 0;
  bool operator==(const TracedLine&) const = default;
};

/// a U + b V + c.
struct TracedPlane {
  double a = 0;
  double b = 0;
  double c = 0;
  bool operator==(const TracedPlane&) const = default;
};

/// How depth or an attribute came about. What a stage handed on is there where the value comes from
/// that; what was computed beside it is not.
struct TracedValue {
  double u = 0;  ///< where it was evaluated, pixels
  double v = 0;
  /// The stage `set_up`: the value is numerator / denominator, or the numerator alone.
  std::optional<TracedPlane> numerator = std::nullopt;
  std::optional<TracedPlane> denominator = std::nullopt;
  /// Or it comes from SampleTrace::lines.
  bool is_from_lines = false;
  /// The stage `weights`: these planes at (u, v).
  std::optional<double> numerator_at = std::nullopt;
  std::optional<double> denominator_at = std::nullopt;
  /// Or a multiple of the weights of the corners there.
  std::optional<std::array<double, 3>> weights = std::nullopt;
  /// The stage `evaluation`: before it was rounded to float32; nothing where that was the last
  /// operation.
  std::optional<double> evaluated = std::nullopt;
  float value = 0;
  bool operator==(const TracedValue&) const = default;
};

struct SampleTrace {
  std::vector<StageTrace> stages;  ///< in the order they ran
  float depth = 0;
  std::vector<float> attributes;

  bool is_drawn = true;  ///< else there are no values
  /// The stage `transform`: the clip positions (x, y, z, w) that were received.
  std::array<std::array<float, 4>, 3> positions{};
  /// The stage `clip_space`, where there is one: the corners of the part that the sample is of.
  std::optional<std::array<TracedCorner, 3>> corners = std::nullopt;
  /// The stage `snap`, where there is one: the same on the grid.
  std::optional<std::array<TracedCorner, 3>> snapped = std::nullopt;
  /// The stage `set_up`: of those corners, or of the vertices where there are none.
  std::optional<TracedFrame> frame = std::nullopt;
  std::optional<std::array<TracedLine, 3>> lines = std::nullopt;
  /// The stage `coverage`: where the sample was taken to be, pixels, E_i there as they were
  /// computed, and how it was decided.
  double u = 0;
  double v = 0;
  std::optional<std::array<double, 3>> edges = std::nullopt;
  std::string decision = {};
  TracedValue traced_depth = {};
  std::vector<TracedValue> traced_attributes = {};
  bool operator==(const SampleTrace&) const = default;
};

/// The stage of a name; nullptr where there is none.
const StageTrace* find_stage(const SampleTrace& trace, std::string_view stage);
/// The number of a name; nothing where there is none.
std::optional<double> find_number(const NamedNumbers& numbers, std::string_view name);

}  // namespace rastercheck::records
