#pragma once

// The backends `mutant:NAME`: the rasterizer with one defect, of any of the lists below. In test
// programs only; the shipped libraries know nothing of mutants.

#include <string>
#include <vector>

namespace rastercheck::mutants {

/// The names of all mutants in tests/mutants/, each made by a patch `NAME.patch`.
const std::vector<std::string>& mutant_names();
/// The names of the mutants in tests/gate/: small changes of precision, for the regression gate.
const std::vector<std::string>& gate_mutant_names();
/// The names of the mutants in tests/mutants/rare/, which random cases do not show.
const std::vector<std::string>& rare_mutant_names();

/// The header of a patch, which describes its mutant before the diff begins; only the first line of
/// each text.
struct Header {
  std::string defect;      ///< what is wrong
  std::string killed_by;   ///< the id of a law; empty if no law can kill the mutant
  std::string equivalent;  ///< why no law can kill it
  std::string of;          ///< the backend whose sources the patch damages
  /// The stage that the exact split of its errors must name (records::Stage); empty: not checked.
  std::string attributed_to;
  /// If a counterexample needs more than three triangles: how many, and why; "8 triangles, …".
  std::string least;
};

/// Reads the header of a mutant's patch; missing fields are empty.
Header header_of(const std::string& mutant);

}  // namespace rastercheck::mutants
