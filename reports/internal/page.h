#pragma once

// The pieces that the sections of report.html are made of, as HTML. Texts handed over are HTML,
// too, unless they are said to be plain.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "records/summary.h"

namespace rastercheck::reports {

inline std::string cell(const std::string& content) { return "<td>" + content + "</td>"; }

/// Cells that a narrow screen, which has no header, shows with their column's name; not where there
/// is nothing in them.
std::string named_cell(std::string_view name, const std::string& content);
std::string number_cell(std::string_view name, const std::string& content);

/// A term and what it is, within <dl>.
std::string definition(std::string_view term, const std::string& content);

/// "label 57", each in a box of its own. Names are plain.
std::string counted_spans(const std::map<std::string, std::uint64_t>& all);

/// The verdict as a word, with a sign for those who skim and a class for its colour.
std::string verdict_mark(const records::LawSummary& row);
/// The same without the reason why a law says nothing.
std::string verdict_word(const records::LawSummary& row);
/// The class of that colour.
std::string_view verdict_class(records::LawVerdict verdict);
/// The sign alone, "✗".
std::string_view verdict_sign(records::LawVerdict verdict);

/// What the page's address has after "#" to show a law, and the id of its section. `law` is plain.
std::string law_link(std::string_view law);
/// The same of the pictures.
inline constexpr std::string_view kPicturesLink = "pictures";
/// The same of an inspection of the run.
std::string inspection_link(std::size_t inspection);

}  // namespace rastercheck::reports
