#include "properties/laws/internal/seen_triangles.h"

#include <algorithm>
#include <cmath>

#include "properties/choices.h"

namespace rastercheck::properties {
namespace {

using records::Verdict;

/// The exact value of a fragment's attribute; empty if the rules allow several.
std::optional<oracle::Rational> exact_value(const oracle::TriangleTruth& truth,
                                            std::size_t attribute,
                                            const cases::SamplePlace& place) {
  if (truth.is_value_free(attribute)) return std::nullopt;
  const auto range = truth.attribute(attribute, static_cast<int>(place.x),
                                     static_cast<int>(place.y), static_cast<int>(place.sample));
  if (!range || range->lo != range->hi) return std::nullopt;
  return range->lo;
}

}  // namespace

SeenTriangles::SeenTriangles(const cases::Case& c, const cases::Contract& contract)
    : scene_(c, contract), truths_(c.triangles.size()) {}

const oracle::TriangleTruth& SeenTriangles::truth(std::uint32_t triangle) {
  auto& truth = truths_[triangle];
  if (!truth) truth = std::make_unique<oracle::TriangleTruth>(scene_, triangle);
  return *truth;
}

std::optional<cases::SamplePlace> SeenTriangles::find(const cases::Picture& picture,
                                                      std::size_t at) {
  cases::SamplePlace place = place_at(picture, at);
  for (place.triangle = static_cast<std::uint32_t>(truths_.size()); place.triangle-- > 0;) {
    const Verdict verdict = truth(place.triangle)
                                .judge(static_cast<int>(place.x), static_cast<int>(place.y),
                                       static_cast<int>(place.sample))
                                .verdict;
    if (verdict == Verdict::required) return place;
    if (verdict == Verdict::permitted) break;
  }
  return std::nullopt;
}

std::optional<Coordinates> exact_coordinates(const oracle::TriangleTruth& truth,
                                             const cases::SamplePlace& place) {
  const auto s = exact_value(truth, 0, place);
  const auto t = exact_value(truth, 1, place);
  return s && t ? std::optional(Coordinates{*s, *t}) : std::nullopt;
}

std::optional<oracle::CoordinateRanges> permitted_coordinates(const oracle::TriangleTruth& truth,
                                                              const cases::SamplePlace& place) {
  const auto range_of = [&](std::size_t attribute) -> std::optional<oracle::ValueRange> {
    const auto x = static_cast<int>(place.x);
    const auto y = static_cast<int>(place.y);
    const auto sample = static_cast<int>(place.sample);
    const auto exact = truth.attribute(attribute, x, y, sample);
    const auto numbers = truth.permitted_numbers(attribute, x, y, sample);
    const bool is_finite =
        numbers && std::isfinite(numbers->least) && std::isfinite(numbers->greatest);
    if (!exact || !is_finite) return std::nullopt;
    // Backends may look up texels at coordinates that they have not rounded to float32.
    return oracle::ValueRange{std::min(exact->lo, oracle::Rational(double{numbers->least})),
                              std::max(exact->hi, oracle::Rational(double{numbers->greatest}))};
  };
  const auto s = range_of(0);
  const auto t = range_of(1);
  return s && t ? std::optional(oracle::CoordinateRanges{*s, *t}) : std::nullopt;
}

std::vector<std::size_t> some_drawn_samples(const cases::Picture& picture, std::size_t most) {
  std::vector<std::size_t> drawn;
  for (std::size_t at = 0; at < picture.depth.size(); ++at) {
    const auto first = picture.color.begin() + static_cast<std::ptrdiff_t>(at * picture.channels);
    const auto end = first + static_cast<std::ptrdiff_t>(picture.channels);
    if (std::any_of(first, end, [](float color) { return color != 0; })) drawn.push_back(at);
  }
  return some_of(drawn, most);
}

}  // namespace rastercheck::properties
