#pragma once

#include <string>

#include "cases/error.h"
#include "reports/compare_format.h"

namespace rastercheck::gate {

/// Saves each grown case that a comparison lists as a case file in the gate's folder
/// (reports::file_of), for replay and explanation. Cases are made again from law, seed and index,
/// or read from the comparison's corpus, by default from the folder `corpus`.
Result<void> save_grown_cases(const reports::Gate& gate, const std::string& corpus);

/// Returns the folder of a comparison's corpus; `without_option` if the comparison's options name
/// none.
std::string corpus_folder_of(const records::Comparison& comparison,
                             const std::string& without_option);

}  // namespace rastercheck::gate
