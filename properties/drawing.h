#pragma once

// Passes a case to a backend and checks what comes back. A backend must not change the
// floating-point environment: the oracle runs in the same process, and another rounding mode would
// falsify every later answer.

#include <cstdint>
#include <span>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::properties {

/// Draws a case without a camera, for judging. The contract need not promise anything: the judge
/// skips unpromised triangles and values. Fails if the backend returns with a changed rounding mode
/// or, on x86, changed FTZ or DAZ (both are restored), or with arrays that do not fit the case or
/// each other.
Result<backends::Drawn> draw(const cases::Case& c, backends::Backend& backend);

/// Draws a case for purposes other than judging; fails unless the contract promises something for
/// all its triangles and values.
Result<backends::Drawn> draw_promised(const cases::Case& c, backends::Backend& backend);

/// Like draw_promised(), but draws the case in one of the backend's ways.
Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way,
                                 backends::Backend& backend);

/// Like draw(), but draws a list, strip or fan of the case's vertices. The backend must have an
/// assembler. (The functions below need a vertex stage or a picture drawer.)
Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                        std::span<const std::uint32_t> indices,
                                        backends::Backend& backend);

/// Returns the clip positions that the backend computes for a case with a camera; checked as in
/// draw().
Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c, backends::Backend& backend);

/// Returns the unit normals that the backend computes from normals; checked as in draw().
Result<std::vector<cases::Normal>> transform_normals(const cases::Matrix4& model,
                                                     std::span<const cases::Normal> normals,
                                                     backends::Backend& backend);

/// Draws the picture of a case without a camera; checked as in draw().
Result<cases::Picture> draw_picture(const cases::Case& c, backends::Backend& backend,
                                    const cases::Pipeline& pipeline);

/// Asks whether the triangles from index `occluders` on are occluded by those before; checked as in
/// draw(). The backend must have an occlusion culler.
Result<bool> is_occluded(const cases::Case& c, std::size_t occluders, backends::Backend& backend);

}  // namespace rastercheck::properties
