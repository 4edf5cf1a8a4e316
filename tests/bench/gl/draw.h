#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "backends/gl/context.h"
#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"
#include "tests/bench/gl/target.h"
#include "tests/bench/gl/texture.h"

namespace rastercheck::backends::gl::bench {

/// The number of attributes of a vertex that Program interpolates.
inline constexpr std::size_t kAttributes = 2;

/// Indexed triangles in clip space, 0 <= z <= w, as they are handed to the GPU.
struct MeshView {
  std::span<const cases::ClipVertex> positions;
  std::span<const float> attributes;  ///< [vertex][attribute]
  std::span<const cases::Triangle> triangles;
};

/// Triangles in the driver's memory.
class Mesh {
 public:
  /// Fails if an index is beyond the positions, a vertex does not have kAttributes attributes, or
  /// memory runs out.
  static Result<Mesh> upload(const Context& context, const MeshView& view);

  Mesh(Mesh&& other) noexcept;
  Mesh& operator=(Mesh&& other) noexcept;
  ~Mesh();

 private:
  friend class Program;
  struct Impl;
  explicit Mesh(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

/// How a texture colours fragments, whose attributes are its coordinates.
struct Texturing {
  const Texture* texture = nullptr;  ///< must outlive the program
  cases::Wrap wrap_s = cases::Wrap::repeat;
  cases::Wrap wrap_t = cases::Wrap::repeat;
  cases::Filter filter = cases::Filter::nearest;
  std::optional<float> discard_below = {};  ///< if set, fragments with less alpha are not drawn
};

/// How a draw's fragments are tested and blended. `always` without writing depth disables the depth
/// test.
struct DrawState {
  cases::DepthFunction depth_function = cases::DepthFunction::less;
  bool writes_depth = true;
  float clear_depth = 1;
  cases::Blend blend = cases::Blend::off;
  float alpha = 1;  ///< of fragments without a texture
  std::optional<Texturing> texturing;
};

/// A draw's state, and shaders that pass positions through. The colour is either the texture's at
/// the attributes, or the two `smooth` attributes as red and green, with blue 0 and the state's
/// alpha.
class Program {
 public:
  static Result<Program> build(const Context& context, const DrawState& state = {});

  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  ~Program();

  /// Clears the target, its colour to 0 and its depth to the state's, and draws all triangles of
  /// the mesh, whatever their facing. NDC (−1, −1) is window (0, 0), and depth 0…w becomes 0…1, as
  /// in Vulkan. Returns when drawing has finished.
  Result<void> draw_frame(const Mesh& mesh, const Target& target) const;

 private:
  struct Impl;
  explicit Program(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl::bench
