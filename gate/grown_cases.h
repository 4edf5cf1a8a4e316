#pragma once

#include <string>

#include "cases/error.h"
#include "reports/compare_format.h"

namespace rastercheck::gate {

/// Saves the cases that a comparison lists as grown, each as a case file of the gate's folder
/// (reports::file_of), so that they can be replayed and explained. They are made again from law,
/// seed and index, or taken from the corpus, in the folder `corpus` where the comparison's options
/// name none.
Result<void> save_grown_cases(const reports::Gate& gate, const std::string& corpus);

/// The folder of the corpus that a comparison's cases are of; `without_option` where its options
/// name none.
std::string corpus_of(const records::Comparison& comparison, const std::string& without_option);

}  // namespace rastercheck::gate
