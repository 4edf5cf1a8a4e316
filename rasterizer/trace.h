#pragma once

// How one sample of a draw came about, stage by stage: for reports that split an error by stages,
// and for whoever asks why.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A sample of a triangle.
struct SampleAddress {
  std::uint32_t triangle = 0;
  int x = 0;
  int y = 0;
  int sample = 0;
};

/// The stage `edges`: from clip positions to the lines E_i = a_i U + (b_i V + c_i T). Numbers as
/// double holds them.
struct TracedEdges {
  std::array<glm::vec4, 3> positions;                   ///< received
  std::array<std::array<double, 3>, 3> coefficients{};  ///< handed on: a, b, c of each edge
  std::array<double, 3> bands{};                        ///< how far an evaluation may be off
  bool is_snapped = false;                              ///< of the snapped vertices, or of a piece
  /// The stage `certificate`: Σ E_i from which on double is enough for smooth values.
  double least_sum = 0;
  bool affine_is_certain = false;  ///< whether it is for values that are linear in the window
  bool depth_is_certain = false;
};

/// How a sample was found to be covered.
enum class Decision {
  in_double,         ///< farther from every edge than double is off
  exactly,           ///< by a sum without rounding, or the fill rule
  in_whole_numbers,  ///< on the subpixel grid
};

/// An attribute, or depth, as the stage `evaluation` handed it on.
struct TracedValue {
  float value = 0;
  bool is_exact = false;     ///< from sums without rounding, as double was not enough; at the
                             ///< sample only: of others it is not recorded
  bool is_at_sample = true;  ///< else at (u, v), its pixel's centre or a sample that is covered
  double u = 0;
  double v = 0;
};

struct Trace {
  TracedEdges edges;
  Decision decision = Decision::in_double;  ///< the stage `coverage`
  std::array<double, 3> place{};            ///< the sample as the edges take it: U, V, T
  /// The stage `weights`: E_i at the sample, each operation of the line rounded once.
  std::array<double, 3> weights{};
  TracedValue depth;
  std::vector<TracedValue> attributes;
};

struct TraceResult {
  std::optional<Error> error;
  std::optional<Trace> trace;  ///< nothing where the sample is not covered, or not of the target
};

/// Draws one triangle as draw_fragments does and says how a sample of it came about. A triangle
/// that the mesh does not have is Error::index.
TraceResult trace_sample(const State& state, const Mesh& mesh, const TargetSize& size,
                         const SampleAddress& address);

}  // namespace rastercheck::rasterizer
