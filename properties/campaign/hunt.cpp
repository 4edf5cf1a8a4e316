#include "properties/campaign/hunt.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "cases/names.h"
#include "oracle/stage_split.h"
#include "oracle/transform.h"
#include "oracle/triangle_truth.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/internal/case_moves.h"
#include "properties/campaign/internal/hunted_errors.h"
#include "properties/choices.h"
#include "properties/fitted_case.h"
#include "properties/fitting.h"
#include "records/record.h"

namespace rastercheck::properties {
namespace {

using cases::Case;

// The shares of steps. They are a choice: most steps climb, and enough of them start anew that the
// archive does not depend on its first entries.

/// One step in 8 checks a random case.
constexpr int kOneInRandom = 8;
/// One of the others in 8 checks a case of the corpus.
constexpr int kOneInCorpus = 8;
/// After each move of a step, another follows once in 2 times, up to this number.
constexpr int kMostMoves = 4;
/// One changed case in 4 keeps all triangles of its parent. The others keep only the triangle in
/// focus, which is faster to check, and decides its values alone.
constexpr int kOneInWhole = 4;
/// Moves that do not apply are replaced by others; so many tries find one that does.
constexpr int kMostChoices = 8;
/// Progress counts about so many of a niche's latest moves: half of them are forgotten when there
/// are twice as many.
constexpr std::uint64_t kLatestMoves = 64;

/// A case to check, and how it was made.
struct HuntStep {
  Case source;
  HuntSource made_by = HuntSource::random;
  std::uint64_t root = 0;
  std::vector<std::string_view> moves;
  std::optional<HuntArchive::Niche> niche = std::nullopt;  ///< of the parent of a moved case
};

/// The share of a move's uses after which the archive kept the case, as if it had been used once
/// more with success and once without.
double success_of(const CaseMove& move, const std::map<std::string_view, MoveCounts>& counts) {
  const auto found = counts.find(move.name);
  const MoveCounts count = found == counts.end() ? MoveCounts() : found->second;
  return (static_cast<double>(count.kept) + 1) / (static_cast<double>(count.made) + 2);
}

/// Chooses the more successful of two random moves.
const CaseMove& choose_move(const std::map<std::string_view, MoveCounts>& counts, Draw& draw) {
  const std::span<const CaseMove> all = case_moves();
  const int last = static_cast<int>(all.size()) - 1;
  const CaseMove& one = all[static_cast<std::size_t>(draw.between(0, last))];
  const CaseMove& other = all[static_cast<std::size_t>(draw.between(0, last))];
  return success_of(other, counts) > success_of(one, counts) ? other : one;
}

/// Makes a changed copy of an entry's case. Moves work on clip positions, so the copy has no
/// camera, unless its clip positions are beyond float32: then it stays as it is.
HuntStep moved_copy(const HuntEntry& parent, const std::map<std::string_view, MoveCounts>& counts,
                    Draw& draw) {
  HuntStep step{parent.source,
                HuntSource::moved,
                parent.root,
                {},
                HuntArchive::Niche{parent.error.kind, parent.error.stratum}};
  step.source.found.reset();
  Result<cases::ClipCase> clip = oracle::to_clip_case(step.source, "");
  if (!clip) return step;
  step.source = *std::move(clip);
  MoveFocus focus{parent.error.at, parent.error.attribute};
  if (step.source.triangles.size() > 1 && !draw.one_in(kOneInWhole)) {
    step.source = with_triangles(step.source, {{focus.at.triangle}});
    focus.at.triangle = 0;
  }
  int choices = 0;
  do {
    const CaseMove& move = choose_move(counts, draw);
    if (move.change(step.source, focus, draw)) step.moves.push_back(move.name);
    ++choices;
  } while (choices < kMostChoices &&
           (step.moves.empty() || (step.moves.size() < kMostMoves && draw.one_in(2))));
  fit_case(draw, step.source);
  return step;
}

/// Returns a task that checks one given case. The case says that the hunt made it, and in which
/// step; a counterexample keeps both (keep_counterexample).
Task task_of(const HuntPlan& plan, Case source, std::uint64_t number) {
  source.found = cases::Found{plan.law, plan.backend, "held", plan.seed, number};
  records::Counterexample subject;
  subject.source = std::move(source);
  subject.origin = records::Origin::saved;
  return {plan.backend, plan.law, TaskKind::saved, 0, 1, std::move(subject)};
}

/// A hunt in progress.
class Hunter {
 public:
  Hunter(const HuntPlan& plan, const Law& law, const std::vector<Case>& corpus,
         const backends::Backend& backend)
      : plan_(&plan),
        law_(&law),
        corpus_(&corpus),
        backend_(&backend),
        stream_("hunt/" + plan.law) {
    outcome_.archive = HuntArchive(plan.guide);
  }

  /// Checks one round; returns false if `execute` ended before the last of its cases.
  Result<bool> round(const Execute& execute) {
    const std::uint64_t first = outcome_.steps;
    const std::uint64_t count = std::min(kStepsPerRound, plan_->steps - first);
    std::vector<HuntStep> steps;
    std::vector<Task> tasks;
    for (std::uint64_t i = 0; i < count; ++i) {
      steps.push_back(make(first + i));
      tasks.push_back(task_of(*plan_, steps.back().source, first + i));
    }
    std::vector<std::optional<Findings>> found(tasks.size());
    const Result<void> done = execute(tasks, [&found](std::size_t task, Findings findings) {
      found[task] = std::move(findings);
      return !found[task]->fault;
    });
    if (!done) return tl::unexpected(done.error());
    for (const std::optional<Findings>& one : found) {
      if (one && one->fault) outcome_.fault = one->fault;
    }
    const auto is_missing = [](const std::optional<Findings>& one) { return !one; };
    if (outcome_.fault || std::any_of(found.begin(), found.end(), is_missing)) return false;
    for (std::uint64_t i = 0; i < count; ++i) take(first + i, steps[i], *std::move(found[i]));
    outcome_.steps += count;
    return true;
  }

  bool is_done() const {
    return outcome_.steps >= plan_->steps || (plan_->fail_fast && outcome_.violations > 0);
  }
  std::uint64_t steps() const { return outcome_.steps; }
  HuntOutcome outcome() {
    outcome_.counterexamples = std::move(findings_.counterexamples);
    return std::move(outcome_);
  }

 private:
  HuntStep make(std::uint64_t number) const {
    Draw draw(plan_->seed, stream_, number, plan_->capabilities);
    const auto random = [&] {
      Generated made = random_case(*law_, plan_->seed, number, plan_->capabilities);
      return HuntStep{std::move(made.source), HuntSource::random, number, {}};
    };
    if (plan_->is_guided && number < plan_->given.size()) {
      const Case& source = plan_->given[number];
      return {fitted_case(plan_->capabilities, source), HuntSource::given, number, {}};
    }
    if (!plan_->is_guided || draw.one_in(kOneInRandom)) return random();
    if (!corpus_->empty() && draw.one_in(kOneInCorpus)) {
      const int chosen = draw.between(0, static_cast<int>(corpus_->size()) - 1);
      const Case& source = (*corpus_)[static_cast<std::size_t>(chosen)];
      return {fitted_case(plan_->capabilities, source), HuntSource::corpus, number, {}};
    }
    const HuntEntry* const parent = outcome_.archive.choose(draw);
    return parent == nullptr ? random() : moved_copy(*parent, outcome_.moves, draw);
  }

  /// Counts the findings of a step and offers its errors to the archive.
  void take(std::uint64_t number, const HuntStep& step, Findings found) {
    ++outcome_.sources[step.made_by];
    std::map<records::AttributeKind, records::ErrorStatistics> errors;
    for (const auto& [key, record] : found.records) {
      errors[key.attribute_kind] = record.errors;
      outcome_.checked += record.cases.checked;
      outcome_.violations += record.cases.violations;
      outcome_.known += record.cases.known;
      for (const auto& [why, count] : record.not_applicable_because) {
        outcome_.not_applicable_because[why] += count;
      }
    }
    for (records::Counterexample& one : found.counterexamples) {
      keep(findings_, std::move(one));
    }
    const bool is_kept = offer(number, step, errors);
    if (step.niche) outcome_.archive.note(*step.niche, is_kept);
    for (const std::string_view move : step.moves) {
      ++outcome_.moves[move].made;
      outcome_.moves[move].kept += is_kept ? 1 : 0;
    }
  }

  bool offer(std::uint64_t number, const HuntStep& step,
             const std::map<records::AttributeKind, records::ErrorStatistics>& errors) {
    const Result<cases::ClipCase> clip = oracle::to_clip_case(step.source, "");
    if (!clip) return false;
    HuntedErrors found = hunted_errors(*clip, backend_->contract(*clip), errors);
    outcome_.not_of_case += found.not_of_case;
    bool is_kept = false;
    for (HuntedError& error : found.all) {
      HuntEntry entry{std::move(error), step.source, number, step.root, step.made_by, step.moves};
      is_kept = outcome_.archive.offer(std::move(entry)) || is_kept;
    }
    return is_kept;
  }

  const HuntPlan* plan_;
  const Law* law_;
  const std::vector<Case>* corpus_;
  const backends::Backend* backend_;
  std::string stream_;
  Findings findings_;  ///< counterexamples only
  HuntOutcome outcome_;
};

}  // namespace

std::optional<double> HuntedError::share() const {
  if (!bound || bound->hi <= 0) return std::nullopt;
  return records::magnitude(excess).lo / bound->hi;
}

double HuntedError::score(Guide guide) const {
  if (guide == Guide::share) return share().value_or(0);
  return ideal ? records::magnitude(*ideal).lo : 0;
}

bool HuntedError::is_beyond_bound() const {
  return !bound || records::magnitude(excess).hi > bound->lo;
}

bool HuntArchive::offer(HuntEntry entry) {
  const double score = entry.error.score(guide_);
  if (!(score > 0) || entry.error.is_beyond_bound()) return false;
  std::vector<HuntEntry>& niche = niches_[{entry.error.kind, entry.error.stratum}];
  const auto same = std::find_if(niche.begin(), niche.end(), [&entry](const HuntEntry& other) {
    return other.root == entry.root;
  });
  if (same != niche.end()) {
    if (same->error.score(guide_) >= score) return false;
    niche.erase(same);
  } else if (niche.size() == kMostEntries) {
    if (niche.back().error.score(guide_) >= score) return false;
    niche.pop_back();
  }
  // Offers come in the order of steps: of equally bad entries, the earlier stays ahead.
  const auto place = std::upper_bound(niche.begin(), niche.end(), score,
                                      [this](double new_score, const HuntEntry& other) {
                                        return new_score > other.error.score(guide_);
                                      });
  niche.insert(place, std::move(entry));
  return true;
}

const HuntEntry* HuntArchive::choose(Draw& draw) const {
  if (niches_.empty()) return nullptr;
  const int last_niche = static_cast<int>(niches_.size()) - 1;
  const auto one = std::next(niches_.begin(), draw.between(0, last_niche));
  const auto other = std::next(niches_.begin(), draw.between(0, last_niche));
  const bool is_one = promise_of(one->first) >= promise_of(other->first);
  const std::vector<HuntEntry>& niche = is_one ? one->second : other->second;
  // The smaller of two ranks: the worst entry is chosen most often, and the least bad one at times.
  const int last = static_cast<int>(niche.size()) - 1;
  const int first_rank = draw.between(0, last);
  const int second_rank = draw.between(0, last);
  return &niche[static_cast<std::size_t>(std::min(first_rank, second_rank))];
}

void HuntArchive::note(const Niche& niche, bool is_kept) {
  Progress& progress = progress_[niche];
  ++progress.made;
  progress.kept += is_kept ? 1 : 0;
  if (progress.made < 2 * kLatestMoves) return;
  progress.made /= 2;
  progress.kept /= 2;
}

double HuntArchive::promise_of(const Niche& niche) const {
  const auto found = progress_.find(niche);
  const Progress progress = found == progress_.end() ? Progress() : found->second;
  return (static_cast<double>(progress.kept) + 1) / (static_cast<double>(progress.made) + 2);
}

Result<HuntOutcome> hunt(const HuntPlan& plan, const std::vector<Case>& corpus,
                         const backends::Backend& backend, const Execute& execute,
                         const Progress& progress) {
  const Law* const law = find_law(plan.law);
  if (law == nullptr) return tl::unexpected(Error{plan.law, "", "no property is called this"});
  Hunter hunter(plan, *law, corpus, backend);
  while (!hunter.is_done()) {
    const Result<bool> goes_on = hunter.round(execute);
    if (!goes_on) return tl::unexpected(goes_on.error());
    if (!*goes_on) break;
    if (progress) progress(hunter.steps(), plan.steps);
  }
  return hunter.outcome();
}

namespace {

/// Checks a case; returns its worst error in a niche, and the check, if the law holds and the score
/// is at least `score`.
std::optional<std::pair<HuntedError, Check>> niche_error(const Law& law, const Case& c,
                                                         const HuntPlan& plan,
                                                         const HuntEntry& like, double score,
                                                         backends::Backend& backend,
                                                         const KnownDefects* known) {
  Check check = check_or_note(law, c, backend, like.step, known);
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (!check.is_applicable || check.fault || !clip) return std::nullopt;
  const HuntedErrors found = hunted_errors(*clip, backend.contract(*clip), check.judgement.errors);
  const HuntedError* worst = nullptr;
  for (const HuntedError& error : found.all) {
    const bool is_alike = error.kind == like.error.kind && error.stratum == like.error.stratum &&
                          !error.is_beyond_bound() && error.score(plan.guide) >= score;
    if (!is_alike) continue;
    if (worst == nullptr || error.score(plan.guide) > worst->score(plan.guide)) worst = &error;
  }
  if (worst == nullptr) return std::nullopt;
  return std::pair(*worst, std::move(check));
}

/// Measures the conditioning of a trophy's sample, and splits its error by stages.
void measure_trophy(HuntTrophy& trophy, backends::Backend& backend) {
  const HuntedError& error = trophy.entry.error;
  const Result<cases::ClipCase> clip = oracle::to_clip_case(trophy.entry.source, "");
  if (!clip) return;
  const cases::Contract contract = backend.contract(*clip);
  if (error.attribute) {
    const oracle::SceneTruth scene(*clip, contract);
    const oracle::TriangleTruth truth(scene, error.at.triangle);
    const auto conditioning =
        truth.conditioning(*error.attribute, static_cast<int>(error.at.x),
                           static_cast<int>(error.at.y), static_cast<int>(error.at.sample));
    if (conditioning && conditioning->kappa) trophy.kappa = conditioning->kappa->nearest_double();
    if (conditioning && conditioning->kappa_d) {
      trophy.kappa_d = conditioning->kappa_d->nearest_double();
    }
  }
  const oracle::StageSplit split(trophy.entry.source, *clip, contract, error.at.triangle);
  std::optional<oracle::ExactSplit> exact;
  if (backends::Tracer* const tracer = backend.tracer()) {
    const auto trace = tracer->trace(*clip, error.at);
    if (trace && *trace) {
      exact = split.traced(error.attribute, error.at.x, error.at.y, error.at.sample, error.actual,
                           **trace);
    }
  }
  if (!exact) {
    exact = split.untraced(error.attribute, error.at.x, error.at.y, error.at.sample, error.actual);
  }
  if (exact) trophy.split = oracle::enclose(*exact);
}

}  // namespace

HuntTrophy trophy_of(const Law& law, const HuntPlan& plan, const HuntEntry& entry,
                     backends::Backend& backend, const ShrinkLimits& limits,
                     const KnownDefects* known) {
  HuntTrophy trophy;
  trophy.entry = entry;
  Case start = entry.source;
  // The law must make the same choices for every smaller version of the case.
  const Result<cases::ClipCase> clip = oracle::to_clip_case(start, "");
  start.choices = clip ? choices_of(*clip) : choices_of(start);
  const double score = entry.error.score(plan.guide);
  const auto still_errs = [&](const Case& c) -> std::optional<Check> {
    auto found = niche_error(law, c, plan, entry, score, backend, known);
    return found ? std::optional(std::move(found->second)) : std::nullopt;
  };
  Case least = start;
  if (limits.tries > 0) {
    Shrunk shrunk = shrink(std::move(start), Check(), still_errs, limits);
    trophy.shrinking = records::Shrinking{shrunk.tries, shrunk.is_least};
    least = std::move(shrunk.source);
  }
  cases::Found found{plan.law, plan.backend, "held", plan.seed, entry.step};
  found.kind = cases::name_of(entry.error.kind);
  if (auto last = niche_error(law, least, plan, entry, score, backend, known)) {
    trophy.entry.source = std::move(least);
    trophy.entry.error = std::move(last->first);
    found.verdict = verdict_of(last->second);
  } else {
    trophy.errs_again = false;
  }
  trophy.entry.source.found = std::move(found);
  measure_trophy(trophy, backend);
  return trophy;
}

}  // namespace rastercheck::properties
