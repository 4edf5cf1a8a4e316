#include "properties/inspect/judged_places.h"

#include <iterator>
#include <map>
#include <optional>

#include "oracle/triangle_truth.h"

namespace rastercheck::properties {
namespace {

/// A drawing's fragments by their places.
using DrawnPlaces = std::multimap<cases::SamplePlace, std::size_t>;

DrawnPlaces places_of(const cases::Fragments& fragments) {
  DrawnPlaces places;
  for (std::size_t i = 0; i < fragments.size(); ++i) places.emplace(fragments.place_of(i), i);
  return places;
}

/// The promised values of a sample, if it is drawn; `fragment` is what is drawn there, if anything.
std::vector<records::PermittedValue> values_of(const oracle::TriangleTruth& truth,
                                               const cases::SamplePlace& at,
                                               const cases::Fragments& fragments,
                                               std::optional<std::size_t> fragment) {
  const auto x = static_cast<int>(at.x);
  const auto y = static_cast<int>(at.y);
  const auto sample = static_cast<int>(at.sample);
  std::vector<records::PermittedValue> values;
  const auto add = [&](std::optional<std::uint32_t> attribute) {
    const auto numbers = truth.permitted_numbers(attribute, x, y, sample);
    if (!numbers) return;
    bool is_right = true;
    if (fragment) {
      const float drawn =
          attribute ? fragments.attributes_of(*fragment)[*attribute] : fragments.depth[*fragment];
      is_right = drawn >= numbers->least && drawn <= numbers->greatest;
    }
    values.push_back({attribute, *numbers, is_right});
  };
  add(std::nullopt);
  for (std::uint32_t a = 0; a < fragments.attribute_count; ++a) add(a);
  return values;
}

bool is_right_count(records::Verdict verdict, std::size_t count) {
  switch (verdict) {
    case records::Verdict::required:
      return count == 1;
    case records::Verdict::forbidden:
      return count == 0;
    case records::Verdict::permitted:
      return count <= 1;
  }
  return false;
}

records::JudgedPlace judged_place(const oracle::TriangleTruth& truth, const cases::SamplePlace& at,
                                  const cases::Fragments& fragments, const DrawnPlaces& drawn) {
  records::JudgedPlace judged;
  judged.place = at;
  judged.verdict =
      truth.judge(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.sample))
          .verdict;
  const auto [first, end] = drawn.equal_range(at);
  const auto count = static_cast<std::size_t>(std::distance(first, end));
  judged.has_right_count = is_right_count(judged.verdict, count);
  if (judged.verdict == records::Verdict::forbidden) return judged;
  judged.values =
      values_of(truth, at, fragments, count > 0 ? std::optional(first->second) : std::nullopt);
  return judged;
}

}  // namespace

std::vector<records::JudgedPlace> judged_places(const cases::ClipCase& c,
                                                const backends::Drawn& drawn,
                                                const records::Inspection& part,
                                                std::size_t most_samples) {
  const oracle::SceneTruth scene(c, drawn.contract);
  const DrawnPlaces fragments = places_of(drawn.fragments);
  const auto per_pixel = static_cast<std::uint32_t>(c.framebuffer.samples);
  const std::size_t per_triangle = std::size_t{part.width} * part.height * per_pixel;
  const bool has_all = per_triangle * c.triangles.size() <= most_samples;
  const std::size_t first = has_all ? 0 : part.place.triangle;
  const std::size_t end = has_all ? c.triangles.size() : first + 1;
  std::vector<records::JudgedPlace> places;
  for (std::size_t triangle = first; triangle < end; ++triangle) {
    const oracle::TriangleTruth truth(scene, triangle);
    for (std::size_t i = 0; i < per_triangle; ++i) {
      cases::SamplePlace at;
      at.triangle = static_cast<std::uint32_t>(triangle);
      at.sample = static_cast<std::uint32_t>(i % per_pixel);
      at.x = part.left + static_cast<std::uint32_t>(i / per_pixel % part.width);
      at.y = part.top + static_cast<std::uint32_t>(i / per_pixel / part.width);
      records::JudgedPlace judged = judged_place(truth, at, drawn.fragments, fragments);
      const bool is_open = judged.verdict == records::Verdict::permitted && judged.values.empty();
      if (!is_open) places.push_back(std::move(judged));
    }
  }
  return places;
}

}  // namespace rastercheck::properties
