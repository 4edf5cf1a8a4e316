#include "properties/inspect/run_cases.h"

#include <bit>
#include <cstddef>
#include <utility>

#include "properties/campaign/shrink.h"

namespace rastercheck::properties {
namespace {

/// Maximum number of triangles of a case that is kept whole. From a larger case one triangle is
/// taken.
constexpr std::size_t kMostTriangles = 8;

}  // namespace

backends::Backend* MadeBackends::find(const std::string& specification) {
  const auto [made, is_new] = made_.try_emplace(specification);
  if (is_new) {
    auto backend = factory_.make(specification);
    if (backend) made->second = *std::move(backend);
  }
  backends::Backend* backend = made->second.get();
  return backend == nullptr || backend->is_lost() ? nullptr : backend;
}

std::optional<CasePart> part_of(cases::Case c, std::uint32_t triangle) {
  if (triangle >= c.triangles.size()) return std::nullopt;
  if (c.triangles.size() <= kMostTriangles) return CasePart{std::move(c), triangle};
  return CasePart{with_triangles(c, {{triangle}}), 0};
}

std::optional<records::Inspection> inspect_part(cases::Case c, const std::string& specification,
                                                Focus focus, MadeBackends& made,
                                                const InspectOptions& options) {
  backends::Backend* backend = made.find(specification);
  if (backend == nullptr) return std::nullopt;
  const std::optional<CasePart> part = part_of(std::move(c), focus.at.triangle);
  if (!part) return std::nullopt;
  focus.at.triangle = part->triangle;
  Result<records::Inspection> inspection = inspect(part->source, *backend, focus, options);
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
