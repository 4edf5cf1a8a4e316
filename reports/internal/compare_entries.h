#pragma once

// The worse and better entries of a comparison, for compare.html.

#include <cstddef>
#include <string>
#include <vector>

#include "records/comparison.h"

namespace rastercheck::reports {

/// The worse entries in this order: first those that no policy allows, then those with wrong
/// samples or values, then by growth in scale ULP. Equal entries keep their order.
std::vector<const records::EntryChange*> worse_entries(const records::Comparison& comparison);

/// The id of an entry's section; `number` is the comparison's number on the page.
std::string entry_id(const records::Comparison& comparison, std::size_t number,
                     const records::EntryChange& entry);

/// A table with one row per worse entry, linked to the sections of entry_sections().
std::string worse_table(const records::Comparison& comparison, std::size_t number);

/// For each of the first worse entries, a section with both distributions, figures and stages.
std::string entry_sections(const records::Comparison& comparison, std::size_t number);

/// The better, new and gone entries; empty if there are none.
std::string other_entries(const records::Comparison& comparison);

}  // namespace rastercheck::reports
