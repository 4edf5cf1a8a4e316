#pragma once

// The backends `mutant:NAME`: the rasterizer with one defect. In test programs only; the shipped
// libraries know nothing of mutants.

#include <string>
#include <vector>

namespace rastercheck::mutants {

/// The names of all mutants that laws kill, as of `NAME.patch`, in their order.
const std::vector<std::string>& mutant_names();
/// The same of tests/gate/: small changes of precision, for the regression gate. A mutant of either
/// kind is a backend.
const std::vector<std::string>& gate_mutant_names();

/// What a patch says of its mutant, before the first line of the diff: of texts the first line.
struct Header {
  std::string defect;      ///< what is wrong
  std::string killed_by;   ///< the id of a law; empty where nothing can kill it
  std::string equivalent;  ///< why nothing can
  std::string of;          ///< the backend whose sources it damages
  /// The stage that the exact split of its errors has to name (records::Stage); empty: not asked.
  std::string attributed_to;
  /// The triangles that show it, and why, where three do not: "8 triangles, …".
  std::string least;
};

/// The header of a mutant's patch; a part that is missing is empty.
Header header_of(const std::string& mutant);

}  // namespace rastercheck::mutants
