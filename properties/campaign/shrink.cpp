#include "properties/campaign/shrink.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "cases/case_writer.h"
#include "properties/campaign/internal/shrink_search.h"

namespace rastercheck::properties {
namespace {

/// The passes, in the order of shrink.h.
constexpr std::array kPasses{&drop_triangles, &simplify_state, &drop_camera,      &set_w_to_one,
                             &move_to_grid,   &drop_bits,      &lessen_exponents, &shrink_viewport};

}  // namespace

ShrinkSearch::ShrinkSearch(cases::Case failing, Check check, const FailsAlike& fails_alike,
                           const ShrinkLimits& limits)
    : shrunk_{std::move(failing), std::move(check), 0, false},
      size_(size_of(shrunk_.source)),
      fails_alike_(&fails_alike),
      limits_(&limits) {}

bool ShrinkSearch::is_over() const {
  return shrunk_.tries >= limits_->tries || (limits_->is_to_end && limits_->is_to_end());
}

bool ShrinkSearch::offer(cases::Case candidate) {
  const CaseSize size = size_of(candidate);
  if (!(size < size_) || is_over()) return false;
  std::string text = cases::to_json(candidate);
  if (refused_.contains(text)) return false;
  ++shrunk_.tries;
  std::optional<Check> check = (*fails_alike_)(candidate);
  if (!check) {
    refused_.insert(std::move(text));
    return false;
  }
  shrunk_.source = std::move(candidate);
  shrunk_.check = *std::move(check);
  size_ = size;
  return true;
}

cases::Case with_triangles(const cases::Case& c, std::span<const std::size_t> triangles) {
  cases::Case some = c;
  some.positions.clear();
  some.attribute_values.clear();
  some.clip_distances.clear();
  some.triangles.clear();
  std::map<std::uint32_t, std::uint32_t> new_index;
  for (const std::size_t triangle : triangles) {
    cases::Triangle renumbered = c.triangles[triangle];
    for (std::uint32_t& vertex : renumbered) {
      const auto next = static_cast<std::uint32_t>(some.positions.size());
      const auto [place, is_new] = new_index.emplace(vertex, next);
      if (is_new) {
        some.positions.push_back(c.positions[vertex]);
        const auto attributes = c.attributes_of(vertex);
        some.attribute_values.insert(some.attribute_values.end(), attributes.begin(),
                                     attributes.end());
        const auto distances = c.clip_distances_of(vertex);
        some.clip_distances.insert(some.clip_distances.end(), distances.begin(), distances.end());
      }
      vertex = place->second;
    }
    some.triangles.push_back(renumbered);
  }
  return some;
}

Shrunk shrink(cases::Case failing, Check check, const FailsAlike& fails_alike,
              const ShrinkLimits& limits) {
  ShrinkSearch search(std::move(failing), std::move(check), fails_alike, limits);
  for (;;) {
    const CaseSize before = size_of(search.current());
    for (const auto& pass : kPasses) pass(search);
    const bool is_over = search.is_over();
    if (!is_over && size_of(search.current()) < before) continue;
    // Choices go last: without them each change of the case would make the law choose differently.
    search.offer_changed([](cases::Case& c) { c.choices.reset(); });
    Shrunk shrunk = search.take();
    shrunk.is_least = !is_over;
    return shrunk;
  }
}

}  // namespace rastercheck::properties
