#include "properties/probing/subject.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "oracle/judge.h"
#include "properties/drawing.h"
#include "properties/law.h"

namespace rastercheck::properties {
namespace {

/// Width and height of a base case, in pixels.
constexpr int kSubjectSide = 64;

cases::ContractTerms of_all_numbers() {
  cases::ContractTerms terms;
  terms.numbers = cases::MagnitudeRange();
  return terms;
}

cases::Contract held(const cases::Case& c, const backends::Backend& backend,
                     const cases::ContractTerms& terms) {
  return cases::with_terms(backend.contract(c), terms, c);
}

}  // namespace

cases::PixelFraction in_lowest_terms(const cases::PixelFraction& at) {
  const int common = std::gcd(std::gcd(at.x, at.y), at.parts);
  return {at.x / common, at.y / common, at.parts / common};
}

CoverageTally& CoverageTally::operator+=(const CoverageTally& other) {
  required += other.required;
  missing += other.missing;
  extra += other.extra;
  return *this;
}

Subject::Subject(std::string name, backends::Backend& backend, const ProbeOptions& options)
    : backend_(&backend), terms_before_(backend.terms()), options_(options), asked_(options.asked) {
  backend.hold_to(of_all_numbers());
  result.backend = std::move(name);
  result.description = backend.about().description;
  result.seed = options.seed;
}

Subject::~Subject() { backend_->hold_to(terms_before_); }

Result<void> Subject::choose_rules() {
  Result<void> chosen;
  for (const cases::Rules rules : {cases::Rules::vulkan, cases::Rules::opengl, cases::Rules::d3d}) {
    rules_ = rules;
    cases::Case c = base();
    add_triangle(c, {-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {0, 1, 0.5F, 1});
    const Result<backends::Drawn> first = draw_promised(c, *backend_);
    ++result.drawings;
    if (first) {
      sample_ = in_lowest_terms(first->contract.sample_position.value_or(kPixelCentre));
      return {};
    }
    if (chosen) chosen = tl::unexpected(first.error());
  }
  return chosen;
}

cases::Case Subject::base(std::optional<cases::Rules> rules) const {
  cases::Case c;
  c.framebuffer = {kSubjectSide, kSubjectSide, 1};
  c.viewport = {0, 0, kSubjectSide, kSubjectSide, 0, 1};
  c.rules = rules.value_or(rules_);
  c.fill_rule = cases::default_fill_rule(c.rules);
  c.basis = cases::default_basis(c.rules);
  ask_of(c);
  return c;
}

void Subject::ask_of(cases::Case& c) const {
  if (asked_.coverage) c.coverage = *asked_.coverage;
  if (asked_.basis) c.basis = *asked_.basis;
  if (asked_.fill_rule) c.fill_rule = *asked_.fill_rule;
}

bool Subject::is_time_up() const {
  if (!was_cut_short_ && options_.is_time_up) was_cut_short_ = options_.is_time_up();
  return was_cut_short_;
}

std::optional<cases::Fragments> Subject::draw(const cases::Case& c) {
  if (backend_->is_lost() || is_time_up()) return std::nullopt;
  Result<backends::Drawn> drawn = draw_promised(c, *backend_);
  if (drawn) {
    ++result.drawings;
    return std::move(drawn->fragments);
  }
  count_failure(drawn.error());
  return std::nullopt;
}

void Subject::count_failure(const Error& error) {
  if (error.failure == Failure::unsupported) {
    ++result.unsupported;
    return;
  }
  ++result.failed;
  if (result.failure.empty()) result.failure = to_string(error);
}

bool Subject::draws_pictures() { return backend_->picture_drawer() != nullptr; }

std::optional<cases::Picture> Subject::draw_picture(const cases::Case& c,
                                                    const cases::Pipeline& pipeline) {
  if (backend_->is_lost() || is_time_up()) return std::nullopt;
  Result<cases::Picture> picture = properties::draw_picture(c, *backend_, pipeline);
  if (!picture) {
    count_failure(picture.error());
    return std::nullopt;
  }
  ++result.drawings;
  return *std::move(picture);
}

std::optional<DrawnCase> Subject::drawn(cases::Case c) {
  std::optional<cases::Fragments> fragments = draw(c);
  if (!fragments) return std::nullopt;
  return DrawnCase{std::move(c), *std::move(fragments)};
}

cases::Contract Subject::contract(const cases::Case& c) const {
  return held(c, *backend_, result.terms);
}

cases::Contract Subject::declared(std::optional<cases::Rules> rules) const {
  cases::Case c = base(rules);
  add_triangle(c, {-0.5F, -0.5F, 0.5F, 1}, {0.5F, -0.5F, 0.5F, 1}, {0, 0.5F, 0.5F, 1});
  return backend_->promise(c);
}

cases::Capabilities Subject::capabilities() const { return capabilities_of(*backend_); }

bool Subject::holds(const std::vector<DrawnCase>& drawn, const cases::ContractTerms& terms) const {
  return std::all_of(drawn.begin(), drawn.end(), [&](const DrawnCase& one) {
    return !is_time_up() && tally({one}, terms).holds();
  });
}

CoverageTally Subject::tally(const std::vector<DrawnCase>& drawn,
                             const cases::ContractTerms& terms) const {
  oracle::JudgeOptions options;
  options.judges_values = false;
  options.shows_ordinary = false;
  CoverageTally tally;
  for (const DrawnCase& one : drawn) {
    if (is_time_up()) break;
    const oracle::SceneTruth scene(one.source, held(one.source, *backend_, terms));
    records::Judgement judged = oracle::judge(scene, one.fragments, options).judgement;
    const records::ClassCounts& classes = judged.errors[records::AttributeKind::coverage].classes;
    tally.required += judged.counts.required;
    tally.missing +=
        classes[records::FragmentClass::missing] + classes[records::FragmentClass::wrong_triangle];
    tally.extra += classes[records::FragmentClass::extra];
  }
  return tally;
}

records::Judgement Subject::judgement(const DrawnCase& drawn,
                                      const cases::ContractTerms& terms) const {
  oracle::JudgeOptions options;
  options.shows_ordinary = false;
  if (is_time_up()) return {};
  const oracle::SceneTruth scene(drawn.source, held(drawn.source, *backend_, terms));
  return oracle::judge(scene, drawn.fragments, options).judgement;
}

records::Measured& Subject::add(std::string what, std::string declared, std::string measured,
                                std::string detail, records::Sureness sureness) {
  result.rows.push_back({std::move(what), std::move(declared), std::move(measured),
                         std::move(detail), false, std::move(sureness)});
  return result.rows.back();
}

}  // namespace rastercheck::properties
