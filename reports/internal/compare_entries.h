#pragma once

// The entries of a comparison that are worse, and those that are better, for compare.html.

#include <cstddef>
#include <string>
#include <vector>

#include "records/comparison.h"

namespace rastercheck::reports {

/// Those that are worse: what no policy allows first, and of these first what came out wrong, then
/// what grew most in scale ULP. Of equals in their order.
std::vector<const records::EntryChange*> worse_entries(const records::Comparison& comparison);

/// The id of an entry's section; `number` is that of the comparison on the page.
std::string entry_id(const records::Comparison& comparison, std::size_t number,
                     const records::EntryChange& entry);

/// A line for each, as a table whose rows link to the sections that entry_sections makes.
std::string worse_table(const records::Comparison& comparison, std::size_t number);

/// Of the first of them both distributions, figures and stages.
std::string entry_sections(const records::Comparison& comparison, std::size_t number);

/// What is better, new and gone; empty where nothing is.
std::string other_entries(const records::Comparison& comparison);

}  // namespace rastercheck::reports
