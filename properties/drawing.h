#pragma once

// A case handed to a backend, and what comes back looked through. A backend has to leave the
// floating-point environment as it found it: the oracle runs in the same process, and another
// rounding mode would falsify every answer after the backend's own.

#include <cstdint>
#include <span>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::properties {

/// Draws a case without a camera, for the judge, which knows what the contract promises nothing of.
/// A backend fails that returns with another rounding mode or, on x86, with another FTZ or DAZ than
/// it was called with (they are put back), or with arrays that do not fit the case or each other.
Result<backends::Drawn> draw(const cases::Case& c, backends::Backend& backend);

/// Draws a case for other questions than the judge's; fails where the contract does not promise
/// something of all its triangles and values.
Result<backends::Drawn> draw_promised(const cases::Case& c, backends::Backend& backend);

/// Draws a case in one of the backend's ways, as by draw_promised().
Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way,
                                 backends::Backend& backend);

/// Draws a list, strip or fan of the case's vertices, as by draw_promised(). The backend has to
/// have an assembler, as it has to have a vertex stage, or a picture drawer, for what follows.
Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                        std::span<const std::uint32_t> indices,
                                        backends::Backend& backend);

/// The clip positions that a backend makes of a case with a camera, watched in the same way.
Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c, backends::Backend& backend);

/// The unit normals that a backend makes of normals, watched in the same way.
Result<std::vector<cases::Normal>> transform_normals(const cases::Matrix4& model,
                                                     std::span<const cases::Normal> normals,
                                                     backends::Backend& backend);

/// The picture that a case without a camera leaves, held to the same as by draw().
Result<cases::Picture> draw_picture(const cases::Case& c, backends::Backend& backend,
                                    const cases::Pipeline& pipeline);

}  // namespace rastercheck::properties
