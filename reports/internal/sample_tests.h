#pragma once

// What exported tests say about a case, in whatever language: the samples that they look at, and
// why some cases cannot be such a test.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/exhibit.h"
#include "reports/internal/case_shaders.h"

namespace rastercheck::reports {

/// The part of the drawing that is inspected.
RecordedPart part_of(const records::Exhibit& exhibit);

/// The sections of specifications that say what must be drawn.
std::vector<std::string> rules_of(const records::Exhibit& exhibit);

/// The reason why no test can draw the case, whatever its API; empty if one can. A test asks for
/// what a driver's contract permits, so a driver has to draw.
std::string why_not_drawn(const records::Exhibit& exhibit);

/// The places that a test looks at; depths only if `has_depth`.
std::vector<records::JudgedPlace> tested_places(const records::Exhibit& exhibit, bool has_depth);

/// The places of each triangle, in their order.
std::vector<std::span<const records::JudgedPlace>> by_triangle(
    std::span<const records::JudgedPlace> places);

/// The reason why a test of these places would not fail where the property is violated; empty if
/// it would, or if nothing is violated.
std::optional<std::string> why_not_shown(const records::Exhibit& exhibit,
                                         const std::vector<records::JudgedPlace>& places);

/// What a test is about, a line each: the fault, what draws it, the rule, the case's name.
std::vector<std::string> test_heading(const records::Exhibit& exhibit);

/// "triangle 0, pixel (3, 5), sample 2: must be drawn".
std::string place_text(const records::JudgedPlace& judged, const cases::Case& c);

}  // namespace rastercheck::reports
