#include "properties/inspect/specimens.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "cases/exact_contract.h"
#include "oracle/triangle_truth.h"
#include "properties/campaign/findings.h"
#include "properties/inspect/crop.h"
#include "records/histogram.h"

namespace rastercheck::properties {
namespace {

using cases::SamplePlace;
using oracle::PixelBox;
using records::AttributeKind;
using records::CaseKey;
using records::CaseRecord;
using records::Specimen;
using records::Stratum;
using records::WorstError;

/// Maximum number of cases tried until one can be shown.
constexpr std::size_t kMostSpecimenTries = 4;
/// Maximum number of triangles of a case searched for a covered sample.
constexpr std::size_t kMostSpecimenTriangles = 8;
/// Number of places tried along each axis of a triangle's box.
constexpr int kPlaces = 9;

bool draws_cases_as_they_stand(std::string_view law) {
  return law == kValuesLaw || law == kCoverageLaw;
}

// --- Where to look -------------------------------------------------------------------------------

/// Returns the pixels that the exact triangle may cover; does not depend on the backend.
PixelBox pixels_of(const CasePart& part) {
  const oracle::SceneTruth scene(part.source,
                                 cases::exact_contract(cases::contract_of(part.source)));
  return oracle::TriangleTruth(scene, part.triangle).pixels();
}

/// Returns the i-th place in [from, to), alternating outwards from the middle.
int place_between(int from, int to, int i) {
  const int steps = i % 2 == 0 ? i / 2 : -(i + 1) / 2;
  return from + (to - from) / 2 + steps * std::max(1, (to - from) / kPlaces);
}

/// Returns a pixel that the exact triangle covers, near its middle; empty if none of the tried
/// pixels is covered.
std::optional<cases::SamplePlace> covered_place(const CasePart& part, std::uint32_t triangle) {
  const oracle::SceneTruth scene(part.source,
                                 cases::exact_contract(cases::contract_of(part.source)));
  const oracle::TriangleTruth truth(scene, part.triangle);
  const cases::FramebufferSize& size = part.source.framebuffer;
  const PixelBox all = truth.pixels();
  const PixelBox box{std::max(all.x0, 0), std::max(all.y0, 0), std::min(all.x1, size.width),
                     std::min(all.y1, size.height)};
  if (box.x0 >= box.x1 || box.y0 >= box.y1) return std::nullopt;
  for (int i = 0; i < kPlaces * kPlaces; ++i) {
    const int x = std::clamp(place_between(box.x0, box.x1, i % kPlaces), box.x0, box.x1 - 1);
    const int y = std::clamp(place_between(box.y0, box.y1, i / kPlaces), box.y0, box.y1 - 1);
    if (truth.judge(x, y, 0).verdict != records::Verdict::required) continue;
    return cases::SamplePlace{triangle, static_cast<std::uint32_t>(y),
                              static_cast<std::uint32_t>(x), 0};
  }
  return std::nullopt;
}

/// Returns a covered pixel of the first triangle that has one.
std::optional<cases::SamplePlace> covered_place(const cases::Case& c) {
  for (std::size_t i = 0; i < std::min(c.triangles.size(), kMostSpecimenTriangles); ++i) {
    const auto triangle = static_cast<std::uint32_t>(i);
    const std::optional<CasePart> part = part_of(c, triangle);
    if (!part) continue;
    if (const auto place = covered_place(*part, triangle)) return place;
  }
  return std::nullopt;
}

// --- Drawing -------------------------------------------------------------------------------------

/// Fills the specimen, whose crop is already set, with the drawn fragments of a triangle.
void fill(Specimen& specimen, const cases::Fragments& drawn, std::uint32_t triangle) {
  specimen.drawn.assign(specimen.sample_count(), false);
  specimen.bits.assign(specimen.sample_count() * specimen.values_per_sample(), 0);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn.triangle[i] != triangle) continue;
    const auto at = specimen.index_of(drawn.x[i], drawn.y[i], drawn.sample[i]);
    if (!at) continue;
    const std::size_t first = *at * specimen.values_per_sample();
    specimen.drawn[*at] = true;
    specimen.bits[first] = std::bit_cast<std::uint32_t>(drawn.depth[i]);
    const std::span<const float> attributes = drawn.attributes_of(i);
    for (std::size_t a = 0; a < attributes.size(); ++a) {
      specimen.bits[first + 1 + a] = std::bit_cast<std::uint32_t>(attributes[a]);
    }
  }
}

/// Draws the crop that `specimen` describes; empty if that is impossible.
std::optional<Specimen> drawn(Specimen specimen, const CasePart& part, CaseDrawer& drawer) {
  const cases::FramebufferSize& size = part.source.framebuffer;
  const bool is_there =
      std::cmp_equal(specimen.samples, size.samples) &&
      specimen.attributes == part.source.attributes.size() &&
      std::cmp_less_equal(std::uint64_t{specimen.left} + specimen.width, size.width) &&
      std::cmp_less_equal(std::uint64_t{specimen.top} + specimen.height, size.height);
  if (!is_there) return std::nullopt;
  const backends::Drawn* const framebuffer = drawer.draw(part.source, specimen.key.backend);
  if (framebuffer == nullptr) return std::nullopt;
  fill(specimen, framebuffer->fragments, part.triangle);
  return specimen;
}

/// A case, and the sample around which to keep a crop.
struct SpecimenSubject {
  CaseKey key;
  std::string name;
  cases::SamplePlace at;
};

/// Draws the pixels around the sample; empty if that is impossible.
std::optional<Specimen> specimen_of(const SpecimenSubject& subject, const cases::Case& c,
                                    CaseDrawer& drawer) {
  const std::optional<CasePart> part = part_of(c, subject.at.triangle);
  if (!part) return std::nullopt;
  const auto x = static_cast<int>(subject.at.x);
  const auto y = static_cast<int>(subject.at.y);
  const PixelBox crop = crop_around(part->source, hull(pixels_of(*part), {x, y, x + 1, y + 1}),
                                    subject.at, records::kMostSpecimenValues);
  Specimen specimen;
  specimen.key = subject.key;
  specimen.case_name = subject.name;
  specimen.triangle = subject.at.triangle;
  specimen.left = static_cast<std::uint32_t>(crop.x0);
  specimen.top = static_cast<std::uint32_t>(crop.y0);
  specimen.width = static_cast<std::uint32_t>(crop.x1 - crop.x0);
  specimen.height = static_cast<std::uint32_t>(crop.y1 - crop.y0);
  specimen.samples = static_cast<std::uint32_t>(part->source.framebuffer.samples);
  specimen.attributes = static_cast<std::uint32_t>(part->source.attributes.size());
  return drawn(std::move(specimen), *part, drawer);
}

// --- The choice ----------------------------------------------------------------------------------

/// The parts kept for one backend, each part of a case once.
class Choice {
 public:
  Choice(const records::Run& run, const CaseSources& sources, std::string backend,
         CaseDrawer& drawer)
      : run_(&run), sources_(&sources), backend_(std::move(backend)), drawer_(&drawer) {}

  void add_firsts();
  void add_worst();

  std::vector<Specimen> take() && {
    std::sort(kept_.begin(), kept_.end(), [](const Specimen& a, const Specimen& b) {
      return std::tie(a.key, a.triangle, a.top, a.left) <
             std::tie(b.key, b.triangle, b.top, b.left);
    });
    return std::move(kept_);
  }

 private:
  struct Candidate {
    const CaseKey* key;
    const CaseRecord* record;
    const WorstError* worst;

    double size() const { return records::magnitude_bound(worst->error); }
  };

  bool is_of_interest(const CaseKey& key) const {
    return key.backend == backend_ && draws_cases_as_they_stand(key.law);
  }
  std::optional<cases::Case> case_of(const CaseKey& key) const {
    return frozen_case(key, run_->plan, sources_->corpus);
  }
  bool has(const CaseKey& key, const cases::SamplePlace& at) const;
  bool add_first(const CaseKey& key, const CaseRecord& record);
  bool add(const Candidate& candidate);
  void keep(Specimen specimen) {
    if (kept_.size() < records::kMostSpecimens) kept_.push_back(std::move(specimen));
  }

  const records::Run* run_;
  const CaseSources* sources_;
  std::string backend_;
  CaseDrawer* drawer_;
  std::vector<Specimen> kept_;
};

/// True if the sample is already kept.
bool Choice::has(const CaseKey& key, const cases::SamplePlace& at) const {
  return std::any_of(kept_.begin(), kept_.end(), [&](const Specimen& one) {
    return one.key == key && one.triangle == at.triangle &&
           one.index_of(at.x, at.y, at.sample).has_value();
  });
}

/// Keeps a part of a case. Returns false if no covered pixel of the case was found.
bool Choice::add_first(const CaseKey& key, const CaseRecord& record) {
  const std::optional<cases::Case> c = case_of(key);
  const std::optional<cases::SamplePlace> place = c ? covered_place(*c) : std::nullopt;
  if (!place) return false;
  // If the backend cannot draw the case, tries no other: the kept cases must not depend on
  // drawings.
  if (std::optional<Specimen> one = specimen_of({key, record.name, *place}, *c, *drawer_)) {
    keep(*std::move(one));
  }
  return true;
}

void Choice::add_firsts() {
  std::map<std::pair<std::string, std::string>, std::size_t> tries;  ///< by law and stratum
  for (const auto& [key, record] : *run_->cases) {
    if (!is_of_interest(key)) continue;
    std::size_t& tried = tries[{key.law, record.stratum}];
    if (tried == kMostSpecimenTries) continue;
    tried = add_first(key, record) ? kMostSpecimenTries : tried + 1;
  }
}

/// Keeps the part around an error. Returns false if the case's own drawing lacks the value with the
/// error, as when the law drew a changed case.
bool Choice::add(const Candidate& candidate) {
  const WorstError& worst = *candidate.worst;
  const cases::SamplePlace& at = worst.place;
  if (has(*candidate.key, at)) return true;
  const std::optional<cases::Case> c = case_of(*candidate.key);
  if (!c) return false;
  std::optional<Specimen> one =
      specimen_of({*candidate.key, candidate.record->name, at}, *c, *drawer_);
  if (!one) return false;
  const auto value = one->value_at(at.x, at.y, at.sample, worst.attribute);
  const bool is_it =
      value && std::bit_cast<std::uint32_t>(*value) == std::bit_cast<std::uint32_t>(worst.actual);
  if (is_it) keep(*std::move(one));
  return is_it;
}

void Choice::add_worst() {
  std::map<std::pair<AttributeKind, Stratum>, std::vector<Candidate>> errors;
  for (const auto& [key, record] : *run_->cases) {
    if (!is_of_interest(key)) continue;
    for (const auto& [kind, strata] : record.worst) {
      if (kind == AttributeKind::flat) continue;  // flat values are copies
      for (const auto& [stratum, worst] : strata) {
        errors[{kind, stratum}].push_back({&key, &record, &worst});
      }
    }
  }
  for (auto& [group, candidates] : errors) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    const std::size_t most = std::min(candidates.size(), kMostSpecimenTries);
    for (std::size_t i = 0; i < most && !add(candidates[i]); ++i) {
    }
  }
}

}  // namespace

std::vector<Specimen> make_specimens(const records::Run& run, const CaseSources& sources,
                                     CaseDrawer& drawer) {
  std::vector<Specimen> all;
  if (!run.cases) return all;
  for (const std::string& backend : run.plan.backends) {
    Choice choice(run, sources, backend, drawer);
    choice.add_firsts();
    choice.add_worst();
    std::vector<Specimen> kept = std::move(choice).take();
    std::move(kept.begin(), kept.end(), std::back_inserter(all));
  }
  return all;
}

std::vector<Specimen> draw_again(std::span<const Specimen> kept, const std::string& backend,
                                 const records::Plan& plan, std::span<const cases::Case> corpus,
                                 CaseDrawer& drawer) {
  std::vector<Specimen> again;
  for (const Specimen& one : kept) {
    Specimen specimen = one;
    specimen.key.backend = backend;  // a baseline may call the backend by another name
    const std::optional<cases::Case> c = frozen_case(specimen.key, plan, corpus);
    const std::optional<CasePart> part = c ? part_of(*c, one.triangle) : std::nullopt;
    if (!part) continue;
    if (auto redrawn = drawn(std::move(specimen), *part, drawer)) {
      again.push_back(*std::move(redrawn));
    }
  }
  return again;
}

}  // namespace rastercheck::properties
