// Measures errors of values by generator, and whether coverage agrees with the earlier measures, on
// random cases of all generators.
//
// Errors are those against the triangle that the basis names (records::ErrorStatistics::ideal).
// Bounds are what a contract has to state: they cover the error beyond the range that coverage and
// basis leave open. A bound is twice the largest error seen, because the drawn cases need not show
// the worst error. Errors of correct rounding (1/2 and almost nothing more) are not doubled. A
// bound is constant unless the hardest cases are much worse than ordinary ones. Then part of the
// bound is per condition or per horizon (cases::ValueBound): twice the least power of four, from
// 2^-8 to 2^8, that covers everything drawn.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "properties/fitting.h"
#include "properties/generator.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;

constexpr std::array kKinds{AttributeKind::smooth, AttributeKind::noperspective,
                            AttributeKind::depth};

/// Generators whose errors are shown one by one.
constexpr std::array<std::string_view, 6> kShown{"ordinary", "slivers", "through-eye",
                                                 "clipping", "huge",    "tiny"};

/// The largest bound under which values are still judged, so that larger errors are measured, too.
constexpr float kUnbounded = 0x1.fffffep23F;

double largest_error(const records::ErrorSizes& sizes) {
  double worst = 0;
  for (const auto& end : {sizes.extremes.most_negative, sizes.extremes.most_positive}) {
    if (end) worst = std::max({worst, std::abs(end->error.lo), std::abs(end->error.hi)});
  }
  return worst;
}

/// The worst errors of one kind of value.
struct WorstUlp {
  double ideal = 0;
  double excess = 0;
  std::uint64_t values = 0;
  std::uint64_t no_numbers = 0;  ///< NaN, and infinities where there should be a number

  void add(const records::ErrorStatistics& errors) {
    ideal = std::max(ideal, largest_error(errors.ideal));
    excess = std::max(excess, largest_error(errors.excess));
    for (const FragmentClass one : {FragmentClass::correct, FragmentClass::beyond_bound}) {
      values += errors.classes[one];
    }
    no_numbers +=
        errors.classes[FragmentClass::not_a_number] + errors.classes[FragmentClass::infinite];
  }
};

using WorstByKind = std::map<AttributeKind, WorstUlp>;

std::optional<cases::ValueBound>& bound_of(cases::ContractTerms& terms, AttributeKind kind) {
  if (kind == AttributeKind::depth) return terms.depth;
  return kind == AttributeKind::smooth ? terms.smooth : terms.noperspective;
}

/// The drawn random cases for which the contract promises something.
using DrawnByGenerator = std::map<std::string, std::vector<DrawnCase>>;

DrawnByGenerator draw_all(Subject& subject) {
  DrawnByGenerator all;
  const AskedDrawing asked = subject.asked();
  const cases::Capabilities capabilities = subject.capabilities();
  subject.ask(subject.options().asked);
  for (const Generator& generator : general_generators()) {
    const std::string name(generator.name);
    for (int i = 0; i < subject.options().cases && !subject.is_time_up(); ++i) {
      MeasureDraw draw(subject, name, static_cast<std::uint64_t>(i), capabilities);
      cases::Case c = generator.make(draw);
      fit_case(draw, c);
      subject.ask_of(c);
      if (!cases::promises_all_of(subject.contract(c), c)) continue;
      std::optional<DrawnCase> drawn = subject.drawn(c);
      // The backend may support the case only with other rules.
      const cases::Rules rules = subject.base().rules;
      if (!drawn && std::exchange(c.rules, rules) != rules) drawn = subject.drawn(std::move(c));
      if (drawn) all[name].push_back(*std::move(drawn));
    }
  }
  subject.ask(asked);
  return all;
}

WorstByKind worst_by_kind(const Subject& subject, const std::vector<DrawnCase>& drawn,
                          const cases::ContractTerms& terms) {
  WorstByKind worst;
  for (const DrawnCase& one : drawn) {
    const records::Judgement judged = subject.judgement(one, terms);
    for (const AttributeKind kind : kKinds) {
      const auto found = judged.errors.find(kind);
      if (found != judged.errors.end()) worst[kind].add(found->second);
    }
  }
  return worst;
}

/// Returns a bound for the largest error seen: twice the error, rounded for readers.
float bound_for(double seen) {
  constexpr double kRounded = 0.51;  // values that are almost correctly rounded
  if (seen <= kRounded) return 0.51F;
  if (!(4 * seen < double{std::numeric_limits<float>::max()})) {
    return std::numeric_limits<float>::max();
  }
  const double power = std::exp2(std::floor(std::log2(2 * seen)));
  for (const double part : {1.0, 1.25, 1.5, 1.75}) {
    if (part * power >= 2 * seen) return static_cast<float>(part * power);
  }
  return static_cast<float>(2 * power);
}

/// True if all values of a kind are within the bounds of the terms.
bool is_within(const Subject& subject, const DrawnByGenerator& drawn, AttributeKind kind,
               const cases::ContractTerms& terms) {
  for (const auto& [name, some] : drawn) {
    for (const DrawnCase& one : some) {
      const records::Judgement judged = subject.judgement(one, terms);
      const auto found = judged.errors.find(kind);
      if (found != judged.errors.end() && found->second.classes[FragmentClass::beyond_bound] > 0) {
        return false;
      }
    }
  }
  return true;
}

/// Returns a bound with a part per condition or, if that does not suffice, per horizon: twice the
/// least power of four tried that covers all values. Empty if none does.
std::optional<cases::ValueBound> varying_bound(const Subject& subject,
                                               const DrawnByGenerator& drawn, AttributeKind kind,
                                               float constant) {
  cases::ContractTerms terms = subject.result.terms;
  for (const auto part : {&cases::ValueBound::per_condition, &cases::ValueBound::per_horizon}) {
    for (int e = -8; e <= 8; e += 2) {
      cases::ValueBound bound{constant};
      bound.*part = std::ldexp(1.0F, e);
      bound_of(terms, kind) = bound;
      if (!is_within(subject, drawn, kind, terms)) continue;
      bound.*part *= 2;
      return bound;
    }
  }
  return std::nullopt;
}

std::string bound_text(const cases::ValueBound& bound) {
  std::string text = fmt::format("{:g}", bound.constant);
  if (bound.per_horizon > 0) text += fmt::format(" + {:g} per horizon", bound.per_horizon);
  if (bound.per_condition > 0) text += fmt::format(" + {:g} per condition", bound.per_condition);
  if (bound.range_share > 0) text += fmt::format(" + {:g} of the range", bound.range_share);
  return text;
}

std::string bound_text(const WorstUlp& worst) {
  std::string text = fmt::format("{:.4g} ULP", worst.ideal);
  if (worst.no_numbers > 0) text += fmt::format(", {} NaN or infinite", worst.no_numbers);
  return text;
}

void measure_bound(Subject& subject, const DrawnByGenerator& drawn, AttributeKind kind,
                   const WorstUlp& ordinary, const WorstUlp& all,
                   const cases::ValueBound& declared) {
  // Hard cases get a varying bound only if they are worse by more than this factor.
  constexpr double kMuchWorse = 16;
  cases::ValueBound bound{bound_for(all.excess)};
  const bool is_much_worse = all.excess > kMuchWorse * std::max(ordinary.excess, 0.5);
  if (kind != AttributeKind::depth && is_much_worse) {
    const auto varying = varying_bound(subject, drawn, kind, bound_for(ordinary.excess));
    if (varying) bound = *varying;
  }
  bound_of(subject.result.terms, kind) = bound;
  // A bound that varies allows each triangle a different error, so only a constant bound can be
  // contradicted by the largest error.
  subject
      .add(fmt::format("bound of {}", records::to_string(kind)), bound_text(declared),
           bound_text(bound), fmt::format("{:.4g} ULP beyond at most", all.excess),
           sure_of("values", all.values, all.no_numbers))
      .contradicts = declared.is_constant() && all.excess > declared.constant;
}

/// Withdraws the promise that depths lie on one side, if some lie on the other.
void measure_side_of_depth(Subject& subject, const DrawnByGenerator& drawn,
                           const cases::ContractTerms& lax) {
  const cases::DepthError declared = subject.declared().depth_error;
  if (declared == cases::DepthError::either_side) return;
  if (drawn.empty()) return;
  const bool is_kept = is_within(subject, drawn, AttributeKind::depth, lax);
  const char* const says =
      declared == cases::DepthError::never_nearer ? "never nearer" : "never farther";
  const records::Sureness sureness = sure_of("generators", drawn.size());
  subject.add("side of depth", says, is_kept ? "kept" : "not kept", "", sureness).contradicts =
      !is_kept;
  if (!is_kept) subject.result.terms.depth_error = cases::DepthError::either_side;
}

void measure_coverage(Subject& subject, const DrawnByGenerator& drawn) {
  std::uint64_t violated = 0;
  std::uint64_t checked = 0;
  std::string generators;
  for (const auto& [name, some] : drawn) {
    const std::uint64_t before = violated;
    for (const DrawnCase& one : some) {
      ++checked;
      if (!subject.tally({one}, subject.result.terms).holds()) ++violated;
    }
    if (violated > before) generators += (generators.empty() ? "of " : ", ") + name;
  }
  subject.add("coverage as measured", kNotDeclared,
              violated == 0 ? fmt::format("holds in {} random cases", checked)
                            : fmt::format("violated in {} of {} random cases", violated, checked),
              generators, sure_of("cases", checked - violated, violated));
}

}  // namespace

void measure_precision(Subject& subject) {
  const DrawnByGenerator drawn = draw_all(subject);
  const auto unbounded = [&subject] {
    cases::ContractTerms terms = subject.result.terms;
    for (const AttributeKind kind : kKinds) bound_of(terms, kind) = cases::ValueBound{kUnbounded};
    return terms;
  };
  measure_side_of_depth(subject, drawn, unbounded());
  const cases::ContractTerms lax = unbounded();
  WorstByKind all;
  WorstByKind ordinary;
  std::map<std::string, WorstByKind> shown;
  // Triangles that may be cut have no single reference value, so the errors that are shown for each
  // generator are measured as if the guard band cut no triangle.
  cases::ContractTerms uncut = lax;
  uncut.guard_band = std::numeric_limits<float>::max();
  if (subject.contract(subject.base()).guard_beyond_viewport) {
    uncut.guard_beyond_viewport = std::numeric_limits<float>::max();
  }
  for (const auto& [name, some] : drawn) {
    const WorstByKind worst = worst_by_kind(subject, some, lax);
    for (const auto& [kind, one] : worst) {
      WorstUlp& most = all[kind];
      most.ideal = std::max(most.ideal, one.ideal);
      most.excess = std::max(most.excess, one.excess);
      most.values += one.values;
      most.no_numbers += one.no_numbers;
    }
    if (name == "ordinary") ordinary = worst;
    if (std::find(kShown.begin(), kShown.end(), name) != kShown.end()) {
      shown[name] = worst_by_kind(subject, some, uncut);
    }
  }
  for (const AttributeKind kind : kKinds) {
    for (const std::string_view generator : kShown) {
      const auto found = shown.find(std::string(generator));
      if (found == shown.end() || found->second[kind].values == 0) continue;
      subject.add(fmt::format("worst error of {}, {}", records::to_string(kind), generator),
                  kNotDeclared, bound_text(found->second[kind]), "",
                  sure_of("values", found->second[kind].values, found->second[kind].no_numbers));
    }
  }
  const cases::ValueBounds declared = subject.declared().bounds;
  const std::array<cases::ValueBound, 3> says{declared.smooth, declared.noperspective,
                                              declared.depth};
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (all[kKinds[i]].values == 0) continue;
    measure_bound(subject, drawn, kKinds[i], ordinary[kKinds[i]], all[kKinds[i]], says[i]);
  }
  measure_coverage(subject, drawn);
}

}  // namespace rastercheck::properties
