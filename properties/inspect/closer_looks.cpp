#include "properties/inspect/closer_looks.h"

#include <algorithm>
#include <utility>

namespace rastercheck::properties {
namespace {

using records::CloserLook;
using records::Specimen;

/// Maximum number of values in a look, unless the baseline determines the part to show.
constexpr std::uint32_t kMostValues = records::kMostSpecimenValues;

/// Returns the part that the baseline kept, if it contains the sample.
std::optional<Specimen> kept_around(const LookRequest& request) {
  const auto& [triangle, y, x, sample] = request.at;
  const bool has_it = request.before && request.before->triangle == triangle &&
                      request.before->index_of(x, y, sample).has_value();
  return has_it ? request.before : std::nullopt;
}

oracle::PixelBox box_of(const Specimen& specimen) {
  const auto left = static_cast<int>(specimen.left);
  const auto top = static_cast<int>(specimen.top);
  return {left, top, left + static_cast<int>(specimen.width),
          top + static_cast<int>(specimen.height)};
}

std::optional<CloserLook> look_closer(const LookRequest& request, const records::Plan& plan,
                                      std::span<const cases::Case> corpus, CaseDrawer& drawer) {
  const std::optional<cases::Case> c = frozen_case(request.key, plan, corpus);
  if (!c) return std::nullopt;
  CloserLook look;
  look.before = kept_around(request);
  InspectOptions options{kMostValues};
  if (look.before) options.crop = box_of(*look.before);
  std::optional<records::Inspection> inspection =
      inspect_part(*c, request.key.backend, {request.at, request.attribute}, drawer, options);
  if (!inspection) return std::nullopt;
  if (request.actual && !shows(*inspection, request.attribute, *request.actual)) {
    return std::nullopt;
  }
  look.key = request.key;
  look.case_name = request.case_name;
  look.triangle = request.at.triangle;
  look.kind = request.kind;
  look.stratum = request.stratum;
  look.inspection = *std::move(inspection);
  look.inspection.occasion = records::Occasion::asked_for;
  look.inspection.law = request.key.law;
  return look;
}

}  // namespace

std::vector<CloserLook> closer_looks(std::span<const LookRequest> requests,
                                     const records::Plan& plan, std::span<const cases::Case> corpus,
                                     CaseDrawer& drawer) {
  std::vector<CloserLook> looks;
  for (const LookRequest& request : requests) {
    if (auto look = look_closer(request, plan, corpus, drawer)) looks.push_back(*std::move(look));
  }
  return looks;
}

std::vector<LookRequest> changed_parts(std::span<const Specimen> kept,
                                       std::span<const Specimen> again, std::size_t most) {
  struct Changed {
    double size;
    LookRequest request;
  };
  std::vector<Changed> changed;
  for (const Specimen& before : kept) {
    const auto after = std::find_if(again.begin(), again.end(), [&before](const Specimen& one) {
      return records::is_same_part(before, one);
    });
    if (after == again.end()) continue;
    const std::optional<records::SpecimenChange> change = records::change_of(before, *after);
    if (!change) continue;
    const auto at = static_cast<std::uint32_t>(change->at);
    const std::uint32_t pixel = at / before.samples;
    LookRequest request;
    request.key = after->key;
    request.case_name = before.case_name;
    request.at = {before.triangle, before.top + pixel / before.width,
                  before.left + pixel % before.width, at % before.samples};
    request.attribute = change->attribute;
    request.before = before;
    changed.push_back({change->size, std::move(request)});
  }
  std::stable_sort(changed.begin(), changed.end(),
                   [](const Changed& a, const Changed& b) { return a.size > b.size; });
  std::vector<LookRequest> requests;
  for (std::size_t i = 0; i < std::min(changed.size(), most); ++i) {
    requests.push_back(std::move(changed[i].request));
  }
  return requests;
}

}  // namespace rastercheck::properties
