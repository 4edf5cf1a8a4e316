#include "properties/inspect/run_cases.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

#include "properties/campaign/shrink.h"
#include "properties/drawing.h"

namespace rastercheck::properties {
namespace {

/// Maximum number of triangles of a case that is kept whole. From a larger case one triangle is
/// taken.
constexpr std::size_t kMostTriangles = 8;
/// Maximum number of fragments in kept drawings, some 40 bytes each.
constexpr std::size_t kMostFragments = std::size_t{1} << 20;

}  // namespace

backends::Backend* CaseDrawer::find(const std::string& specification) {
  const auto [made, is_new] = made_.try_emplace(specification);
  if (is_new) {
    auto backend = factory_.make(specification);
    if (backend) made->second = *std::move(backend);
  }
  backends::Backend* backend = made->second.get();
  return backend == nullptr || backend->is_lost() ? nullptr : backend;
}

const backends::Drawn* CaseDrawer::draw(const cases::ClipCase& c,
                                        const std::string& specification) {
  backends::Backend* const backend = find(specification);
  if (backend == nullptr) return nullptr;
  const auto same = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& one) {
    return one.specification == specification && one.source.given() == c.given();
  });
  if (same != kept_.end()) return &same->drawn;
  Result<backends::Drawn> drawn = properties::draw(c, *backend);
  if (!drawn) return nullptr;
  fragments_ += drawn->fragments.size();
  if (fragments_ > kMostFragments) {
    kept_.clear();
    fragments_ = drawn->fragments.size();
  }
  kept_.push_back({specification, c, *std::move(drawn)});
  return &kept_.back().drawn;
}

std::optional<CasePart> part_of(const cases::Case& c, std::uint32_t triangle) {
  if (triangle >= c.triangles.size()) return std::nullopt;
  const bool is_large = c.triangles.size() > kMostTriangles;
  Result<cases::ClipCase> source = case_to_draw(is_large ? with_triangles(c, {{triangle}}) : c);
  if (!source) return std::nullopt;
  return CasePart{*std::move(source), is_large ? 0 : triangle};
}

std::optional<records::Inspection> inspect_part(const cases::Case& c,
                                                const std::string& specification, Focus focus,
                                                CaseDrawer& drawer, const InspectOptions& options) {
  backends::Backend* const backend = drawer.find(specification);
  const std::optional<CasePart> part = part_of(c, focus.at.triangle);
  if (backend == nullptr || !part) return std::nullopt;
  const backends::Drawn* const drawn = drawer.draw(part->source, specification);
  if (drawn == nullptr) return std::nullopt;
  focus.at.triangle = part->triangle;
  const TracedSample trace = trace_sample(part->source, focus.at, *backend);
  Result<records::Inspection> inspection = inspect(part->source, *drawn, focus, trace, options);
  if (!inspection) return std::nullopt;
  inspection->backend = specification;
  return *std::move(inspection);
}

bool shows(const records::Inspection& inspection, std::optional<std::uint32_t> attribute,
           float actual) {
  const records::InspectedSample* sample = records::inspected_sample(inspection);
  if (sample == nullptr) return false;
  const std::size_t value = attribute ? std::size_t{1} + *attribute : 0;
  if (value >= sample->values.size() || !sample->values[value].actual) return false;
  return std::bit_cast<std::uint32_t>(*sample->values[value].actual) ==
         std::bit_cast<std::uint32_t>(actual);
}

}  // namespace rastercheck::properties
