#include "properties/law.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "oracle/transform.h"
#include "properties/fitting.h"
#include "properties/generator.h"

namespace rastercheck::properties {
namespace {

std::vector<Law>& law_registry() {
  static std::vector<Law> all;
  return all;
}

}  // namespace

LawRegistration::LawRegistration(const Law& law) {
  const auto after = std::find_if(law_registry().begin(), law_registry().end(),
                                  [&law](const Law& other) { return other.id > law.id; });
  law_registry().insert(after, law);
}

std::span<const Law> laws() { return law_registry(); }

const Law* find_law(std::string_view id) {
  const auto found = std::find_if(law_registry().begin(), law_registry().end(),
                                  [id](const Law& law) { return law.id == id; });
  return found == law_registry().end() ? nullptr : &*found;
}

namespace {

/// Before laws had ids, their random cases depended on their sentences. For all but four laws,
/// replacing the id's hyphens by spaces gives the old sentence, so the cases of those laws stay the
/// same.
std::string stream_of(const Law& law) {
  std::string stream(law.id);
  std::replace(stream.begin(), stream.end(), '-', ' ');
  return stream;
}

}  // namespace

Draw draw_of(const Law& law, std::uint64_t seed, std::uint64_t index) {
  return Draw(seed, stream_of(law), index);
}

Generated random_case(const Law& law, std::uint64_t seed, std::uint64_t index,
                      const cases::Capabilities& capabilities) {
  Draw draw(seed, stream_of(law), index, capabilities);
  Generated made = law.generate(draw);
  fit_case(draw, made.source);
  return made;
}

cases::Capabilities capabilities_of(const backends::Backend& backend) {
  cases::Capabilities capabilities = backend.about().capabilities;
  // A contract file may promise only a range of magnitudes that does not contain 1. No case can be
  // made for such a range, so it is ignored.
  const cases::MagnitudeRange numbers = backend.contract({}).numbers;
  if (numbers.has(1)) capabilities.numbers = numbers;
  return capabilities;
}

std::uint64_t least_reached(const Cover& cover, std::uint64_t checked) {
  // Chernoff: of a binomial with mean μ, P(X <= μ − t) <= exp(−t² / 2μ), which is 10^-6 if t² = 2 μ
  // ln 10^6.
  constexpr double kTwiceLnOfMillion = 27.631021115928547;
  const double mean = static_cast<double>(checked) * cover.percent / 100;
  const double least = mean - std::sqrt(kTwiceLnOfMillion * mean);
  return least > 0 ? static_cast<std::uint64_t>(std::ceil(least)) : 0;
}

bool draws_what_is_asked_for(backends::Backend& backend) {
  cases::Case c;
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    c.rules = rules;
    c.fill_rule = cases::default_fill_rule(rules);
    c.basis = cases::default_basis(rules);
    for (const cases::Coverage& coverage :
         {cases::Coverage(), cases::Coverage(cases::Snapping())}) {
      c.coverage = coverage;
      const cases::Contract promised = backend.contract(c);
      const cases::Contract asked_for = cases::contract_of(c);
      if (promised.coverage != asked_for.coverage || promised.tie_rule != asked_for.tie_rule ||
          promised.claims != asked_for.claims) {
        return false;
      }
      if (coverage && promised.basis != asked_for.basis) return false;
    }
  }
  return true;
}

bool draws_invariantly(backends::Backend& backend) { return backend.contract({}).is_invariant; }

bool draws_all_parts_once(backends::Backend& backend) {
  const cases::Contract contract = backend.contract({});
  const bool is_owned =
      contract.has_one_owner_of_ties() || contract.tie_rule == cases::TieRule::unspecified;
  return is_owned && contract.draws_every_triangle();
}

bool covers_pixels(backends::Backend& backend) {
  return backend.contract({}).conservative.has_value();
}

bool covers_touched_pixels(backends::Backend& backend) {
  const auto conservative = backend.contract({}).conservative;
  return conservative && conservative->kind == cases::ConservativeKind::outer;
}

Result<Check> check_law(const Law& law, const cases::Case& c, backends::Backend& backend,
                        std::uint64_t index) {
  const bool is_excluded = !is_promised(law, backend);
  const bool lacks_triangles =
      c.primitive != cases::Primitive::triangles && !law.takes_lines_and_points;
  if (is_excluded || lacks_triangles) {
    Check none;
    none.is_applicable = false;
    none.why_not = is_excluded ? why_unpromised(law, backend)
                               : std::string_view("the property is about triangles");
    return none;
  }
  if (law.check_given != nullptr) return law.check_given(c, backend, index);
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  return law.check(*clip, backend, index);
}

bool is_promised(const Law& law, backends::Backend& backend) {
  if (law.needs_samples && covers_pixels(backend)) return false;
  if (law.excludes_outer && covers_touched_pixels(backend)) return false;
  return law.is_promised == nullptr || law.is_promised(backend);
}

std::string_view why_unpromised(const Law& law, backends::Backend& backend) {
  if (law.needs_samples && covers_pixels(backend)) {
    return "the backend covers whole pixels, not samples";
  }
  if (law.excludes_outer && covers_touched_pixels(backend)) {
    return "the backend covers pixels beyond the triangle";
  }
  return law.unpromised.empty() ? "the backend does not promise this property" : law.unpromised;
}

records::BackendPromises promises_of(const std::string& name, backends::Backend* backend,
                                     std::span<const std::string> laws) {
  records::BackendPromises promises;
  promises.backend = name;
  if (backend == nullptr) return promises;
  promises.has_limits = backend->about().has_limits;
  promises.promise = backend->driver_promise();
  promises.draws_what_is_asked_for = draws_what_is_asked_for(*backend);
  for (const std::string& law_name : laws) {
    const Law* law = find_law(law_name);
    if (law != nullptr && !is_promised(*law, *backend)) promises.unpromised.push_back(law_name);
  }
  return promises;
}

Generated generate_any(Draw& draw) {
  const std::span<const Generator> all = general_generators();
  assert(!all.empty());
  const int chosen = draw.between(0, static_cast<int>(all.size()) - 1);
  const Generator& generator = all[static_cast<std::size_t>(chosen)];
  return {generator.make(draw), std::string(generator.name)};
}

}  // namespace rastercheck::properties
