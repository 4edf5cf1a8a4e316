#pragma once

// The backends `mutant:NAME`: the rasterizer with one defect. In test programs only; the shipped
// libraries know nothing of mutants.

#include <string>
#include <vector>

namespace rastercheck::mutants {

/// The names of all mutants, as of `NAME.patch`, in their order.
const std::vector<std::string>& mutant_names();

/// What a patch says of its mutant, before the first line of the diff.
struct Header {
  std::string defect;     ///< one sentence, or how it begins
  std::string killed_by;  ///< the name of a law
  std::string of;         ///< the backend whose sources it damages
};

/// The header of a mutant's patch; a part that is missing is empty.
Header header_of(const std::string& mutant);

}  // namespace rastercheck::mutants
