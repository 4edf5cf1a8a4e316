#pragma once

// The HTML pieces from which the sections of report.html are made. Text arguments are HTML, except
// those described as plain text.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "records/summary.h"

namespace rastercheck::reports {

inline std::string cell(const std::string& content) { return "<td>" + content + "</td>"; }

/// Table cells with the name of their column, which is shown on a narrow screen, where tables have
/// no header. Empty cells show no name.
std::string named_cell(std::string_view name, const std::string& content);
std::string number_cell(std::string_view name, const std::string& content);

/// A term and its definition, within <dl>.
std::string definition(std::string_view term, const std::string& content);

/// "label 57" for each entry, in a box of its own. The names are plain text.
std::string counted_spans(const std::map<std::string, std::uint64_t>& all);

/// The verdict as a word, with a sign for readers who skim, and a class for its colour.
std::string verdict_word(const records::LawSummary& row);
/// The class for the verdict's colour.
std::string_view verdict_class(records::LawVerdict verdict);
/// Only the sign, such as "✗".
std::string_view verdict_sign(records::LawVerdict verdict);

/// The fragment (after "#") of the page's address that shows a law, which is also the id of its
/// section. `law` is plain text.
std::string law_link(std::string_view law);
/// The fragment that shows the pictures.
inline constexpr std::string_view kPicturesLink = "pictures";
/// The fragment that shows an inspection of the run.
std::string inspection_link(std::size_t inspection);

}  // namespace rastercheck::reports
