#pragma once

#include <string>

#include "cases/error.h"
#include "reports/compare_format.h"

namespace rastercheck::cli {

/// Saves the cases that a comparison lists as grown, each as a case file of the gate's folder
/// (reports::file_of), so that they can be replayed and explained. They are made again from law,
/// seed and index, or taken from the corpus.
Result<void> save_grown_cases(const reports::Gate& gate);

/// The folder of the corpus that a comparison's cases are of.
std::string corpus_of(const reports::Comparison& comparison);

}  // namespace rastercheck::cli
