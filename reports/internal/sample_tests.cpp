#include "reports/internal/sample_tests.h"

#include <fmt/format.h>

#include <algorithm>

#include "cases/json.h"
#include "reports/finding_text.h"

namespace rastercheck::reports {

RecordedPart part_of(const records::Exhibit& exhibit) {
  if (!exhibit.inspection) return {};
  return {exhibit.inspection->left, exhibit.inspection->top, exhibit.inspection->width,
          exhibit.inspection->height};
}

std::vector<std::string> rules_of(const records::Exhibit& exhibit) {
  if (!exhibit.rules.empty()) return exhibit.rules;
  switch (exhibit.source.rules) {
    case cases::Rules::opengl:
      return {"OpenGL 4.6, 14.6.1 Basic Polygon Rasterization"};
    case cases::Rules::vulkan:
      return {"Vulkan 1.3, Basic Polygon Rasterization"};
    case cases::Rules::d3d:
      return {"Direct3D 11.3 Functional Specification, Rasterization Rules"};
  }
  return {};
}

std::string why_not_drawn(const records::Exhibit& exhibit) {
  // Vertex inputs that every OpenGL and Vulkan has.
  constexpr std::size_t kMostVectors = 16;
  const cases::Case& c = exhibit.source;
  if (!exhibit.backend.starts_with("gl") && !exhibit.backend.starts_with("vulkan")) {
    return fmt::format("{} is no driver; choose one with --backend",
                       cases::printable(exhibit.backend));
  }
  if (c.rules == cases::Rules::d3d) return "it is drawn by Direct3D's rules";
  if (c.depth_test != cases::DepthTest::none) return "it has a depth test";
  if (c.primitive != cases::Primitive::triangles) return "it has no triangles";
  if (1 + attribute_vectors(c) + clip_vectors(c) > kMostVectors)
    return "it has too many attributes";
  return "";
}

std::vector<records::JudgedPlace> tested_places(const records::Exhibit& exhibit, bool has_depth) {
  std::vector<records::JudgedPlace> places = exhibit.places;
  for (records::JudgedPlace& judged : places) {
    // If no number is right, a sample that may be left out has none to begin with.
    const bool may_be_open = judged.verdict == records::Verdict::permitted;
    std::erase_if(judged.values, [&](const records::PermittedValue& value) {
      return (!has_depth && !value.attribute) ||
             (may_be_open && value.numbers.least > value.numbers.greatest);
    });
  }
  return places;
}

std::vector<std::span<const records::JudgedPlace>> by_triangle(
    std::span<const records::JudgedPlace> places) {
  std::vector<std::span<const records::JudgedPlace>> parts;
  while (!places.empty()) {
    const auto end = std::find_if(places.begin(), places.end(), [&](const auto& judged) {
      return judged.place.triangle != places.front().place.triangle;
    });
    const auto count = static_cast<std::size_t>(end - places.begin());
    parts.push_back(places.first(count));
    places = places.subspan(count);
  }
  return parts;
}

std::optional<std::string> why_not_shown(const records::Exhibit& exhibit,
                                         const std::vector<records::JudgedPlace>& places) {
  if (exhibit.violation_count == 0) return std::nullopt;
  const auto is_wrong = [](const records::JudgedPlace& judged) {
    return !judged.has_right_count ||
           std::any_of(judged.values.begin(), judged.values.end(),
                       [](const records::PermittedValue& value) { return !value.is_right; });
  };
  if (std::any_of(places.begin(), places.end(), is_wrong)) return std::nullopt;
  if (std::any_of(exhibit.places.begin(), exhibit.places.end(), is_wrong)) {
    return "only its depth is wrong, and that cannot be read: the case has several samples, or "
           "clamps depths";
  }
  return fmt::format(
      "it breaks “{}”, but no sample that a test looks at is drawn too often or too seldom, or "
      "with a wrong number",
      exhibit.sentence);
}

std::vector<std::string> test_heading(const records::Exhibit& exhibit) {
  std::vector<std::string> lines;
  const auto add = [&](std::string_view title, std::string_view text) {
    if (!text.empty()) lines.push_back(fmt::format("{}{}", title, cases::one_line(text)));
  };
  if (exhibit.violations.empty()) {
    add("", fmt::format("“{}” holds on {}.", exhibit.sentence, exhibit.backend));
  } else {
    add("", finding_text(exhibit.violations.front(), exhibit.source) + ".");
    add("Drawn by ",
        exhibit.backend + (exhibit.description.empty() ? "" : ": ") + exhibit.description);
    for (const std::string& rule : rules_of(exhibit)) add("Rule: ", rule);
  }
  add("Case: ", exhibit.source.name);
  if (exhibit.subpixel_bits) {
    add("", fmt::format("Asks for what a driver with {} subpixel bits may draw; with fewer it says "
                        "nothing.",
                        *exhibit.subpixel_bits));
  }
  add("Made by ", exhibit.found_with);
  return lines;
}

std::string place_text(const records::JudgedPlace& judged, const cases::Case& c) {
  const auto& [triangle, y, x, sample] = judged.place;
  std::string text = fmt::format("triangle {}, pixel ({}, {})", triangle, x, y);
  if (c.framebuffer.samples > 1) text += fmt::format(", sample {}", sample);
  switch (judged.verdict) {
    case records::Verdict::required:
      return text + ": must be drawn";
    case records::Verdict::forbidden:
      return text + ": must not be drawn";
    case records::Verdict::permitted:
      return text + ": may be drawn";
  }
  return text;
}

}  // namespace rastercheck::reports
