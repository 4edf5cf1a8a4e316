#pragma once

// The accuracy table (records/accuracy.h) as text.

#include <cstddef>
#include <optional>
#include <string>

#include "records/accuracy.h"

namespace rastercheck::reports {

/// A table for a terminal, the most exact row first: the least largest error of ordinary smooth
/// values. Wider tables than `columns` are folded (text_table.h).
std::string accuracy_text(const std::vector<records::AccuracyRow>& rows,
                          std::optional<std::size_t> columns);

/// The same as a table in Markdown.
std::string accuracy_markdown(const std::vector<records::AccuracyRow>& rows);

}  // namespace rastercheck::reports
