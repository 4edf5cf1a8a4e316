#pragma once

// A piglit test as text: its sections, its vertices, and the draws of its section [test] with the
// state that each of them has. How a test is read is up to piglit's shader_runner; this follows its
// tests/shaders/shader_runner.c and tests/util/piglit-vbo.cpp.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/importers/shader_test_shader.h"

namespace rastercheck::cases::shader_test_importer {

inline constexpr int kPlanes = 8;

/// A column of [vertex data]; the runner fills components that it lacks from (0, 0, 0, 1).
struct Column {
  std::string name;      ///< of the attribute, or its location as text
  bool is_float = true;  ///< others are read over
  std::size_t count = 0;
};

struct VertexData {
  std::vector<Column> columns;
  std::vector<std::vector<float>> rows;  ///< [row][number], all columns in order
};

/// What the commands before a draw have set.
struct DrawState {
  FramebufferSize framebuffer;
  Viewport viewport;
  std::optional<Matrix4> projection;
  bool is_projection_rounded = false;
  std::array<std::array<float, 4>, kPlanes> planes{};
  std::array<bool, kPlanes> enabled{};
  bool has_depth_test = false;      ///< which has a depth buffer
  std::optional<float> depth;       ///< of the depth buffer; empty if undefined
  std::size_t clears = 0;           ///< before the draw, if there is a depth test
  bool is_depth_test_void = false;  ///< enabled, but there is no depth buffer
  bool has_depth_clamp = false;
  bool is_two_sided = false;  ///< colours of back faces are others
  bool is_flat = false;       ///< the shade model
  bool is_first_provoking = false;
  std::string unsayable;  ///< why nothing that is drawn becomes a case; else empty
  bool operator==(const DrawState&) const = default;
};

enum class Shape { triangles, strip, fan, quads, quad_strip, polygon, rectangle, other };

/// "draw arrays", or a rectangle of four vertices as a strip.
struct DrawCommand {
  std::size_t line = 0;
  Shape shape = Shape::other;
  std::string mode;         ///< as the file has it
  std::uint32_t first = 0;  ///< row of the vertex data
  std::uint32_t count = 0;
  std::array<float, 4> rectangle{};              ///< x, y, width, height in the vertex' space
  std::optional<std::array<float, 4>> textured;  ///< likewise of texture coordinates
  DrawState state;
};

struct Script {
  std::vector<SourceLine> vertex_shader;
  std::vector<SourceLine> fragment_shader;
  std::optional<VertexData> data;
  std::vector<DrawCommand> draws;
  std::size_t probes = 0;
  std::size_t test_line = 0;  ///< of the heading [test]
};

Expected<Script> read_script(std::string_view text);

/// True if a text begins like a piglit test, after comments.
bool begins_like_a_test(std::string_view text);

}  // namespace rastercheck::cases::shader_test_importer
