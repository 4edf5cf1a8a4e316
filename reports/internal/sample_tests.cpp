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

std::string why_not_drawn(const cases::Case& c) {
  // Vertex inputs that every OpenGL and Vulkan has.
  constexpr std::size_t kMostVectors = 16;
  if (c.rules == cases::Rules::d3d) return "it is drawn by Direct3D's rules";
  if (c.depth_test != cases::DepthTest::none) return "it has a depth test";
  if (1 + attribute_vectors(c) + clip_vectors(c) > kMostVectors)
    return "it has too many attributes";
  return "";
}

std::vector<records::JudgedPlace> tested_places(const records::Exhibit& exhibit, bool has_depth) {
  std::vector<records::JudgedPlace> places = exhibit.places;
  if (has_depth) return places;
  for (records::JudgedPlace& judged : places) {
    std::erase_if(judged.values,
                  [](const records::PermittedValue& value) { return !value.attribute; });
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
      "no sample is wrong by itself, but only that “{}”; a test says what must be drawn at each "
      "sample of one triangle",
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
    for (const std::string& rule : exhibit.rules) add("Rule: ", rule);
  }
  add("Case: ", exhibit.source.name);
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
