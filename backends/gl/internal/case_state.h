#pragma once

// A case in GL's words, for the context that is current.

#include <epoxy/gl.h>

#include <span>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/varyings.h"
#include "cases/case.h"

namespace rastercheck::backends::gl {

/// The vertices of triangles, three each, for a pass: position, varyings and clip distances, four
/// floats each, and the triangle's number among these, from 1; one after the other. What has no
/// value is 0, clip distances that the case does not have are inside.
std::vector<float> vertices_of(const Capabilities& has, const cases::Case& c,
                               std::span<const cases::Triangle> triangles, const Pass& pass);

/// Puts vertices_of() into the buffer and makes it the input of a case's program.
void hand_over_vertices(const Capabilities& has, const cases::Case& c,
                        std::span<const cases::Triangle> triangles, const Pass& pass,
                        GLuint vertex_array, GLuint buffer);

/// Everything but the scissor test, which clears heed: set it when the target is cleared.
void set_case_state(const Capabilities& has, const cases::Case& c);
void set_scissor(const cases::Case& c);
/// What other draws than those of cases do not expect.
void reset_case_state(const Capabilities& has);

}  // namespace rastercheck::backends::gl
