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
// Shaders that are ready to use, and textures, are in texture.h and below.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// What exact arithmetic says of a batch's attributes, for where double leaves a doubt.
class ExactAttributes {
 public:
  virtual ~ExactAttributes() = default;
  /// ⌊scale · r⌋ modulo `period`, r the attribute at a covered lane as it is before any rounding:
  /// some number that differs from it by a multiple, exactly, less than 2 · period from 0. `period`
  /// is a whole number below 2^51, or infinite: then it is ⌊scale · r⌋, beyond 2^53 a double next
  /// to it.
  virtual double floor(std::size_t attribute, std::size_t lane, double scale, double period) = 0;
};

/// Samples that are shaded at once: cells of 8×2 pixels, each of one triangle and one sample index.
/// A cell begins at an even column and an even row, so that it is four quads of 2×2 pixels. Lanes
/// that are not covered are helpers: their values are those of the triangle's plane beyond it, so
/// that differences within a quad can be had; anything where 1/w <= 0, or next to that.
///
/// Lane l is in cell l / 16, at the pixel (x + l % 8, y + l / 8 % 2) of it; its neighbours in its
/// quad are l ^ 1 along x and l ^ 8 along y.
struct FragmentBatch {
  static constexpr std::size_t kCellWidth = 8;
  static constexpr std::size_t kCellLanes = 16;
  static constexpr std::size_t kCells = 8;
  static constexpr std::size_t kLanes = kCells * kCellLanes;

  struct Cell {
    std::uint32_t triangle = 0;
    std::uint16_t covered = 0;  ///< bit l % 16: the lane is no helper
    std::uint16_t x = 0;
    std::uint16_t y = 0;
    std::uint16_t sample = 0;
  };

  std::size_t lanes = 0;  ///< kCellLanes for each cell
  std::span<const Cell> cells;
  /// [attribute][lane], aligned to 64 bytes: in double, before any rounding to float32. NaNs are
  /// quiet.
  std::span<const double* const> values;
  /// ∂r/∂u and ∂r/∂v per pixel of the window, [attribute][lane]; with `uses_derivatives` alone.
  std::span<const double* const> along_u;
  std::span<const double* const> along_v;
  /// [attribute]: no value of a covered lane is off by more than this and more than kErrorShare of
  /// itself, which is the greater only beyond the triangle that it comes from: at Location::center
  /// with several samples, and with Basis::ideal where snapping moves an edge over a sample.
  std::span<const double> errors;
  static constexpr double kErrorShare = 0x1p-31;
  ExactAttributes* exact = nullptr;  ///< never nullptr where a shader is called
};

/// What a shader makes of a batch.
struct ShadedBatch {
  std::span<float* const> color;       ///< [output][lane], aligned to 64 bytes; to be filled in
  std::span<std::uint16_t> discarded;  ///< [cell]: bits as FragmentBatch::Cell::covered; 0 at first

  void discard(std::size_t lane) {
    discarded[lane / FragmentBatch::kCellLanes] |=
        static_cast<std::uint16_t>(1U << lane % FragmentBatch::kCellLanes);
  }
};

/// `outputs()`: the channels that it fills in, as many as the framebuffer has. It may be called on
/// several threads at once, in any order. `uses_derivatives()`, where there is one, says whether it
/// wants along_u and along_v.
///
/// `discards()`, where there is one, says whether it ever discards; whoever has none may. Of one
/// that says false only what is seen in the end is shaded, unless it is blended, and discarding has
/// no effect.
template <typename Shader>
concept FragmentShader = requires(const Shader& shader, const FragmentBatch& in, ShadedBatch& out) {
  shader(in, out);
  { shader.outputs() } -> std::convertible_to<std::size_t>;
};

/// Any FragmentShader.
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

/// draw() of what a shader makes of the attributes. The shader must outlive the call.
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

/// An attribute of all lanes, each rounded once: out[lane], aligned to 64 bytes.
void round_values(const FragmentBatch& in, std::size_t attribute, float* out);

/// The attributes as they are, each rounded once.
struct AttributesShader {
  std::size_t count = 0;
  std::size_t outputs() const { return count; }
  bool discards() const { return false; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const;
};

/// Gouraud's: the first four attributes are red, green, blue and alpha; alpha is 1 where there are
/// three.
struct GouraudShader {
  std::size_t outputs() const { return 4; }
  bool discards() const { return false; }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const;
};

}  // namespace rastercheck::rasterizer
