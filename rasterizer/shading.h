#pragma once

// The fragment stage: a functor that turns attributes into colours, for many fragments at once.
//
//   struct Red {
//     std::size_t outputs() const { return 4; }
//     void operator()(const FragmentBatch& in, ShadedBatch& out) const {
//       for (std::size_t lane = 0; lane < in.lanes; ++lane) {
//         out.color[0][lane] = 1;
//         …
//       }
//     }
//   };
//   draw(state, mesh, Red(), framebuffer);
//
// Ready-made shaders are below and, with textures, in texture.h.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Answers questions about a batch's lanes that few shaders ask, by evaluating single lanes.
class ExactAttributes {
 public:
  virtual ~ExactAttributes() = default;
  /// Returns ⌊scale · r⌋ modulo `period`, where r is the attribute at a covered lane before any
  /// rounding. The result has a magnitude below 2 · period and differs from ⌊scale · r⌋ by an exact
  /// multiple of `period`. `period` must be a whole number below 2^51, or infinite. If `period` is
  /// infinite, returns ⌊scale · r⌋ itself or, beyond 2^53, a neighbouring double.
  virtual double floor(std::size_t attribute, std::size_t lane, double scale, double period) = 0;
  /// True if the lane's triangle is a front face (State::front_face).
  virtual bool is_front(std::size_t lane) = 0;
  /// The depth of a covered lane, as it is stored.
  virtual float depth(std::size_t lane) = 0;
  /// 1/w at a covered lane's sample, with a relative error of at most 2^-50.
  virtual double reciprocal_w(std::size_t lane) = 0;
};

/// Samples that are shaded together, in cells of 8×2 pixels. All samples of a cell have the same
/// triangle and sample index. A cell begins at an even column and an even row, so it consists of
/// four quads of 2×2 pixels. Lanes that are not covered are helpers: they hold values of the
/// triangle's plane outside the triangle, for differences within a quad. Where 1/w <= 0, or next to
/// such a place, a helper's values are arbitrary.
///
/// Lane l belongs to cell l / 16 and to its pixel (x + l % 8, y + l / 8 % 2). The lane's neighbours
/// in its quad are l ^ 1 along x and l ^ 8 along y.
struct FragmentBatch {
  static constexpr std::size_t kCellWidth = 8;
  static constexpr std::size_t kCellLanes = 16;
  static constexpr std::size_t kCells = 8;
  static constexpr std::size_t kLanes = kCells * kCellLanes;

  struct Cell {
    std::uint32_t triangle = 0;
    std::uint16_t covered = 0;  ///< bit l % 16 is set if lane l is covered, not a helper
    std::uint16_t x = 0;
    std::uint16_t y = 0;
    std::uint16_t sample = 0;
  };

  std::size_t lanes = 0;  ///< kCellLanes times the number of cells
  std::span<const Cell> cells;
  /// [attribute][lane], aligned to 64 bytes: values in double, before any rounding to float32.
  /// Every NaN is quiet.
  std::span<const double* const> values;
  /// [attribute][lane]: ∂r/∂u and ∂r/∂v per pixel of the window. Filled only if the shader has
  /// `uses_derivatives`.
  std::span<const double* const> along_u;
  std::span<const double* const> along_v;
  /// [attribute]: a covered lane's value has an error of at most this or kErrorShare times the
  /// value, whichever is greater. The latter can be greater only outside the triangle: at
  /// Location::center with several samples, and with Basis::ideal if snapping moves an edge over a
  /// sample.
  std::span<const double> errors;
  static constexpr double kErrorShare = 0x1p-31;
  ExactAttributes* exact = nullptr;  ///< never nullptr when a shader is called
};

/// A shader's output for a batch.
struct ShadedBatch {
  std::span<float* const> color;  ///< [output][lane], aligned to 64 bytes; the shader fills it
  std::span<std::uint16_t>
      discarded;  ///< [cell]: bits as in FragmentBatch::Cell::covered; 0 at first

  void discard(std::size_t lane) {
    discarded[lane / FragmentBatch::kCellLanes] |=
        static_cast<std::uint16_t>(1U << lane % FragmentBatch::kCellLanes);
  }
};

/// A functor that shades batches. It may be called on several threads at once, in any order.
/// `outputs()` returns the number of channels that it fills; this must equal the framebuffer's. The
/// optional `uses_derivatives()` returns true if the functor needs along_u and along_v.
///
/// The optional `discards()` returns true if the functor may discard fragments, which is assumed of
/// a functor without it. If discards() returns false, only finally visible fragments are shaded
/// (unless they are blended), and discarding has no effect.
template <typename Shader>
concept FragmentShader = requires(const Shader& shader, const FragmentBatch& in, ShadedBatch& out) {
  shader(in, out);
  { shader.outputs() } -> std::convertible_to<std::size_t>;
};

/// Type-erased reference to any FragmentShader.
struct ShaderView {
  const void* shader = nullptr;
  void (*shade)(const void* shader, const FragmentBatch& in, ShadedBatch& out) = nullptr;
  std::size_t outputs = 0;
  bool uses_derivatives = false;
  bool discards = true;
};

template <FragmentShader Shader>
ShaderView view_of(const Shader& shader) {
  ShaderView view;
  view.shader = &shader;
  view.shade = [](const void* object, const FragmentBatch& in, ShadedBatch& out) {
    (*static_cast<const Shader*>(object))(in, out);
  };
  view.outputs = shader.outputs();
  if constexpr (requires { shader.uses_derivatives(); }) {
    view.uses_derivatives = shader.uses_derivatives();
  }
  if constexpr (requires { shader.discards(); }) view.discards = shader.discards();
  return view;
}

/// Like draw(), but draws the shader's outputs instead of the attributes. The shader must outlive
/// the call.
DrawResult draw_by(const ShaderView& shader, const State& state, const Mesh& mesh,
                   Picture& framebuffer, unsigned threads = 1);
DrawResult clear_and_draw_by(const ShaderView& shader, const State& state, const Mesh& mesh,
                             const TargetSize& size, float depth, Picture& framebuffer,
                             unsigned threads = 1);

template <FragmentShader Shader>
DrawResult draw(const State& state, const Mesh& mesh, const Shader& shader, Picture& framebuffer,
                unsigned threads = 1) {
  return draw_by(view_of(shader), state, mesh, framebuffer, threads);
}

template <FragmentShader Shader>
DrawResult clear_and_draw(const State& state, const Mesh& mesh, const Shader& shader,
                          const TargetSize& size, float depth, Picture& framebuffer,
                          unsigned threads = 1) {
  return clear_and_draw_by(view_of(shader), state, mesh, size, depth, framebuffer, threads);
}

/// Writes an attribute of all lanes, each value rounded once, to out[lane]. `out` must be aligned
/// to 64 bytes.
void round_values(const FragmentBatch& in, std::size_t attribute, float* out);

/// Outputs the attributes unchanged, each rounded once.
struct AttributesShader {
  std::size_t count = 0;
  std::size_t outputs() const { return count; }
  bool discards() const { return false; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const;
};

/// Gouraud shading: the first four attributes are red, green, blue and alpha. If the vertices have
/// only three, alpha is 1.
struct GouraudShader {
  std::size_t outputs() const { return 4; }
  bool discards() const { return false; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const;
};

}  // namespace rastercheck::rasterizer
