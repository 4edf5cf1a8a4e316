#pragma once

// Translates a case into GL state, for the current context.

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/varyings.h"
#include "backends/indexed_draw.h"
#include "cases/case.h"

namespace rastercheck::backends::gl {

/// The most vertex inputs of a program.
inline constexpr std::size_t kMostInputs = 16;

/// The number of vertex inputs of a pass.
std::size_t inputs_of(const Capabilities& has, const Pass& pass);

/// The vertex data of a pass: three vertices per triangle, two per line, one per point. Each vertex
/// has its position, varyings and clip distances as vectors of four floats, then the number of its
/// triangle, line or point in the span, counted from 1. Missing values are 0. Clip distances that
/// the case lacks are positive, so that they clip nothing.
std::vector<float> vertices_of(const Capabilities& has, const cases::Case& c,
                               std::span<const cases::Triangle> triangles, const Pass& pass);
/// Likewise, the vertices of a draw of indices with their numbers.
std::vector<float> vertices_of(const Capabilities& has, const cases::Case& c,
                               const IndexedDraw& indexed, const Pass& pass);

/// Puts vertices, as vertices_of() returns them, into the buffer and sets it as the input of a
/// case's program.
void hand_over_vertices(const Capabilities& has, const Pass& pass, std::span<const float> vertices,
                        GLuint vertex_array, GLuint buffer);

/// Makes a case's program the current one, and hands over the size of points.
void use_program(GLuint program, const cases::Case& c);

/// Draws `count` triangles, lines or points, from that with index `first` on, of those that were
/// handed over.
void draw_primitives(const cases::Case& c, std::size_t first, std::size_t count);
/// Draws the indices of a draw whose vertices were handed over. `buffer` is for the indices.
void draw_indices(const Capabilities& has, const cases::Case& c, const IndexedDraw& indexed,
                  GLuint buffer);

/// Sets the case's state except the scissor test, which also affects clears: set that with
/// set_scissor() after clearing the target.
void set_case_state(const Capabilities& has, const cases::Case& c);
void set_scissor(const cases::Case& c);
/// Resets the state that other drawing code expects to have its default value.
void reset_case_state(const Capabilities& has);

}  // namespace rastercheck::backends::gl
