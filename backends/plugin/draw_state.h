#pragma once

// A case in the words of plugin.h, for shared libraries and for files of draws.

#include <vector>

#include "backends/plugin/plugin.h"
#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::backends {

/// The state of a case's draws and the lengths of its arrays, without the arrays and triangles.
/// `promised` is what the backend that will draw the case promises about it.
rastercheck_draw draw_state(const cases::Case& c, const cases::Contract& promised);

/// rastercheck_draw.sample_positions: [sample][2], within the pixel.
std::vector<float> sample_places(const cases::Case& c);

/// rastercheck_draw.attributes.
std::vector<rastercheck_attribute> plugin_attributes(const cases::Case& c);

}  // namespace rastercheck::backends
