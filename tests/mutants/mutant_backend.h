#pragma once

// The backends `mutant:NAME`: the rasterizer with one defect. In test programs only; the shipped
// libraries know nothing of mutants.

#include <string>
#include <vector>

namespace rastercheck::mutants {

/// The names of all mutants, as of `NAME.patch`, in their order.
const std::vector<std::string>& mutant_names();

}  // namespace rastercheck::mutants
