#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "backends/gl/context.h"
#include "backends/gl/target.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

/// Attributes of a vertex that Program interpolates.
inline constexpr std::size_t kAttributes = 2;

/// Indexed triangles in clip space, 0 <= z <= w, as the GPU is to have them.
struct MeshView {
  std::span<const cases::ClipVertex> positions;
  std::span<const float> attributes;  ///< [vertex][attribute]
  std::span<const cases::Triangle> triangles;
};

/// Triangles in the driver's memory.
class Mesh {
 public:
  /// Fails where an index is beyond the positions, a vertex has not kAttributes attributes, or
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

/// Shaders that hand positions through and write both attributes, `smooth`, as red and green; blue
/// is 0 and alpha 1.
class Program {
 public:
  static Result<Program> build(const Context& context);

  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  ~Program();

  /// Clears the target, colour to 0 and depth to 1, and draws the mesh: every triangle, whatever
  /// its facing, where its depth is less than the sample's. NDC (−1, −1) is window (0, 0), depth
  /// 0…w becomes 0…1: as Vulkan has it. Returns when all is drawn.
  Result<void> draw_frame(const Mesh& mesh, const Target& target) const;

 private:
  struct Impl;
  explicit Program(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl
