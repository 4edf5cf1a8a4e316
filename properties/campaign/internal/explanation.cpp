#include "properties/campaign/internal/explanation.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "oracle/transform.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/internal/amendment.h"
#include "properties/campaign/internal/hints.h"
#include "properties/campaign/internal/put_right.h"
#include "properties/campaign/internal/variations.h"
#include "properties/drawing.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using records::DrawnPart;

enum class Outcome {
  fails,
  holds,
  says_nothing,  ///< the law does not apply, or the backend does not draw the case
};

/// Checks a law on changed versions of a case.
class Experiment {
 public:
  Experiment(const Law& law, backends::Backend& backend, std::uint64_t index,
             const KnownDefects* known, bool is_drawn)
      : law_(&law), backend_(&backend), index_(index), known_(known), is_drawn_(is_drawn) {}

  /// Returns the law's outcome if these parts of the drawing are corrected.
  Outcome outcome(const cases::Case& c, const DrawnParts& parts) const {
    const MoreAmended put_right_too(
        *backend_, [&](const cases::Case& drawn_case, cases::Fragments& drawn) {
          put_right(drawn_case, backend_->contract(drawn_case), parts, drawn);
        });
    const Check check = check_or_note(*law_, c, *backend_, index_, known_);
    if (!check.is_applicable || check.fault) return Outcome::says_nothing;
    if (check.violation_count == 0 || !check.known.empty()) return Outcome::holds;
    // A failed drawing and a wrong drawing are different failures.
    const bool is_drawn = check.violations.empty() || check.violations.front().has_place();
    return is_drawn == is_drawn_ ? Outcome::fails : Outcome::says_nothing;
  }

  /// Returns the parts of the case's own drawing that are wrong by the contract.
  DrawnParts wrong_parts(const cases::Case& source) const {
    const Result<cases::ClipCase> c = oracle::to_clip_case(source, "");
    if (!c) return {};
    const Result<backends::Drawn> drawn = draw(*c, *backend_);
    if (!drawn) return {};
    DrawnParts wrong;
    const Check check = judge_drawn(*c, drawn->contract, drawn->fragments, {}, index_);
    for (const auto& [kind, errors] : check.judgement.errors) {
      const auto& counts = errors.classes.counts;
      const bool is_right =
          std::all_of(counts.begin() + 1, counts.end(), [](std::uint64_t n) { return n == 0; });
      if (is_right) continue;
      wrong.insert(part_of(kind));
    }
    return wrong;
  }

 private:
  const Law* law_;
  backends::Backend* backend_;
  std::uint64_t index_;
  const KnownDefects* known_;
  bool is_drawn_;  ///< whether the counterexample is a wrong drawing, not a failed one
};

const DrawnParts& all_parts() {
  static const DrawnParts kAll{DrawnPart::coverage, DrawnPart::depth, DrawnPart::values};
  return kAll;
}

DrawnParts parts_besides(const DrawnParts& parts) {
  DrawnParts rest;
  std::set_difference(all_parts().begin(), all_parts().end(), parts.begin(), parts.end(),
                      std::inserter(rest, rest.end()));
  return rest;
}

/// Returns the smallest set of parts whose correction makes the law hold; empty if none does.
DrawnParts parts_to_put_right(const Experiment& experiment, const cases::Case& c) {
  const auto holds = [&](const DrawnParts& parts) {
    return experiment.outcome(c, parts) == Outcome::holds;
  };
  for (const DrawnPart part : all_parts()) {
    if (holds({part})) return {part};
  }
  if (!holds(all_parts())) return {};
  for (const DrawnPart part : all_parts()) {
    if (const DrawnParts rest = parts_besides({part}); holds(rest)) return rest;
  }
  return all_parts();
}

/// Returns the case with a framebuffer that shows more of its triangles.
cases::Case with_room(cases::Case c) {
  constexpr int kRoom = 32;  // pixels; a triangle may have several hundred samples
  c.framebuffer.width = std::max(c.framebuffer.width, kRoom);
  c.framebuffer.height = std::max(c.framebuffer.height, kRoom);
  return c;
}

/// For each part, counts the cases in which "the part is wrong in the case's own drawing" and "the
/// law fails" are both true or both false, and the other cases.
class Coincidence {
 public:
  /// `wrong`: the parts that are wrong in a case for which the law fails.
  Coincidence(const Experiment& experiment, const DrawnParts& wrong) : experiment_(&experiment) {
    for (const DrawnPart part : wrong) counts_[part].alike = 1;
  }

  void take(const cases::Case& c, Outcome outcome) {
    if (counts_.empty() || outcome == Outcome::says_nothing) return;
    const DrawnParts wrong = experiment_->wrong_parts(c);
    for (auto& [part, count] : counts_) {
      const bool is_alike = wrong.contains(part) == (outcome == Outcome::fails);
      ++(is_alike ? count.alike : count.unlike);
    }
  }

  /// Returns the parts that, in at least three of four cases, were wrong if and only if the law
  /// failed. Does not require all cases: a law that also draws other cases may fail because of
  /// those.
  DrawnParts parts() const {
    DrawnParts parts;
    for (const auto& [part, count] : counts_) {
      if (count.unlike * 3 <= count.alike) parts.insert(part);
    }
    return parts;
  }

 private:
  struct Count {
    int alike = 0;
    int unlike = 0;
  };

  const Experiment* experiment_;
  std::map<DrawnPart, Count> counts_;
};

/// A case from which features are removed, and the place where it fails.
struct Base {
  cases::Case source;
  cases::SamplePlace at;
};

/// The result of removing one feature from all bases.
struct Finding {
  bool is_there = false;
  bool holds = false;
  bool fails = false;
};

Finding finding_of(const Variation& variation, const std::vector<Base>& bases,
                   const Experiment& experiment, const DrawnParts& put_right,
                   Coincidence& coincidence) {
  Finding finding;
  for (const Base& base : bases) {
    cases::Case other = base.source;
    if (finding.fails || !take_away(variation, other, base.at)) continue;
    finding.is_there = true;
    const Outcome outcome = experiment.outcome(other, put_right);
    coincidence.take(other, outcome);
    finding.holds = finding.holds || outcome == Outcome::holds;
    finding.fails = outcome == Outcome::fails;
  }
  return finding;
}

/// Returns the shrunk case, then the other cases for which the law fails, too.
std::vector<Base> bases_of(const Experiment& experiment, const records::Counterexample& shrunk,
                           cases::Case found_at_first, const DrawnParts& put_right) {
  const cases::SamplePlace at =
      shrunk.violations.empty() ? cases::SamplePlace{} : shrunk.violations.front().place;
  std::vector<Base> bases{{shrunk.source, at}};
  found_at_first.name = shrunk.source.name;
  for (cases::Case other : {with_room(shrunk.source), std::move(found_at_first)}) {
    const bool is_new = std::none_of(bases.begin(), bases.end(),
                                     [&other](const Base& base) { return base.source == other; });
    if (is_new && experiment.outcome(other, put_right) == Outcome::fails) {
      bases.push_back({std::move(other), at});
    }
  }
  return bases;
}

}  // namespace

std::optional<records::Explanation> explain(const Law& law, backends::Backend& backend,
                                            const records::Counterexample& shrunk,
                                            const cases::Case& found_at_first,
                                            const KnownDefects* known, const IsToEnd& is_to_end) {
  const auto is_over = [&] { return (is_to_end && is_to_end()) || backend.is_lost(); };
  const cases::Found& found = *shrunk.source.found;
  const bool is_drawn = shrunk.violations.empty() || shrunk.violations.front().has_place();
  const Experiment experiment(law, backend, found.index, known, is_drawn);
  records::Explanation explanation;
  const Outcome again = experiment.outcome(shrunk.source, {});
  if (is_over() || again == Outcome::says_nothing) return std::nullopt;
  explanation.fails_again = again == Outcome::fails;
  if (!explanation.fails_again) return explanation;
  const DrawnParts parts = parts_to_put_right(experiment, shrunk.source);
  explanation.parts.assign(parts.begin(), parts.end());
  if (parts.empty()) {
    for (const Law& other : laws()) {
      if (is_over()) return std::nullopt;
      if (other.id == law.id) continue;
      const Experiment of_other(other, backend, found.index, known, is_drawn);
      const bool fails = of_other.outcome(shrunk.source, all_parts()) == Outcome::fails;
      if (fails) explanation.also_violates.emplace_back(other.id);
    }
  }
  // Corrects the other parts, so that another fault is not mistaken for this one. If that alone
  // makes the law hold, corrects nothing.
  DrawnParts others = parts.empty() ? DrawnParts{} : parts_besides(parts);
  if (experiment.outcome(shrunk.source, others) != Outcome::fails) others = {};
  const std::vector<Base> bases = bases_of(experiment, shrunk, found_at_first, others);
  // If no correction helps, the law may judge something that the backend makes from its own
  // fragments, such as a picture, and that is wrong whenever the fragments are.
  Coincidence coincidence(experiment,
                          parts.empty() ? experiment.wrong_parts(shrunk.source) : DrawnParts{});
  for (const Variation& variation : variations()) {
    if (is_over()) return std::nullopt;
    const Finding finding = finding_of(variation, bases, experiment, others, coincidence);
    if (finding.fails) {
      explanation.indifferent.emplace_back(variation.id);
    } else if (finding.holds) {
      explanation.needs.emplace_back(variation.id);
    } else if (finding.is_there) {
      explanation.inherent.emplace_back(variation.id);
    }
  }
  const DrawnParts wrong = coincidence.parts();
  explanation.wrong.assign(wrong.begin(), wrong.end());
  // Hints are about these parts only, because other parts may be wrong for other reasons.
  const DrawnParts& in_question = parts.empty() ? wrong : parts;
  if (!in_question.empty()) {
    explanation.hints = hints_of(found_at_first, backend, in_question, is_over);
  }
  if (is_over()) return std::nullopt;
  return explanation;
}

}  // namespace rastercheck::properties
