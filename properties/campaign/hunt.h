#pragma once

// A hunt: the search for cases on which a backend errs as much as possible. It is guided by the
// errors that a law's check measures, where a campaign only samples.
//
// Each step checks one case: a random case of the law, a case of the corpus, or a changed copy of a
// case that did badly (internal/case_moves.h). Step i chooses from Draw(seed, "hunt/" + law, i);
// its random case is case i of a campaign with the same seed. The first steps check given cases, if
// there are any: the worst of earlier hunts.
//
// The guide. The judge gives a value two errors (oracle/judge.h): the excess, beyond what the
// contract leaves open, and the ideal error, against the exact triangle. A verdict compares the
// excess with the bound, so the share excess / bound says how near a value is to a wrong verdict,
// and 1 is the limit. By default the share guides, for two reasons. Where a contract leaves
// snapping open, the ideal error is mostly what snapping moved: any steep attribute raises it, and
// it says nothing about the values' arithmetic. Where the bound grows with the condition of the
// sample, so does the largest error, and a search for the error alone would run to the samples for
// which least is promised. If a backend leaves nothing open and its bound is a constant, both
// guides order cases alike. Guide::error searches for the ideal error itself. Reports show both
// errors and the bound of every case, whatever guided.
//
// The archive keeps the worst cases of each niche, a kind of value and a stratum, apart, so that
// the search does not end in one corner; parents are chosen evenly among niches. Of the cases that
// descend from one random or corpus case, a niche keeps only the worst, so that a niche does not
// fill with copies. Values beyond the bound are violations, which are results of their own: the
// first of each kind is kept as a counterexample, and its values do not guide the search.
//
// Steps come in rounds. All steps of a round choose from the archive as the round before left it,
// and their results enter in the order of steps. So the outcome depends on the seed and the number
// of steps alone, not on how many processes check the cases.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "cases/capabilities.h"
#include "cases/case.h"
#include "cases/error.h"
#include "cases/sample_place.h"
#include "properties/campaign/campaign_run.h"
#include "properties/campaign/findings.h"
#include "properties/campaign/known_defects.h"
#include "properties/campaign/shrink.h"
#include "properties/draw.h"
#include "properties/law.h"
#include "records/counterexample.h"
#include "records/enclosure.h"
#include "records/judgement.h"
#include "records/stage_split.h"

namespace rastercheck::properties {

/// The quantity that a hunt tries to raise: excess / bound, or the ideal error.
enum class Guide { share, error };
constexpr auto names_of(Guide /*type*/) {
  return std::to_array<std::string_view>({"share", "error"});
}

/// Where a hunted case came from.
enum class HuntSource { random, corpus, moved, given };
constexpr auto names_of(HuntSource /*type*/) {
  return std::to_array<std::string_view>({"random", "corpus", "moved", "given"});
}

/// The errors of one value. Enclosures are signed, and in the unit of the kind.
struct HuntedError {
  records::AttributeKind kind = records::AttributeKind::depth;
  records::Stratum stratum = records::Stratum::ordinary;
  cases::SamplePlace at = {};
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; empty for depth
  float actual = 0;
  std::string exact;  ///< a fraction, or a range of two
  /// Against the exact triangle; empty for centroids, and if that triangle has no value.
  std::optional<records::Enclosure> ideal;
  records::Enclosure excess;                ///< beyond what the contract leaves open
  std::optional<records::Enclosure> bound;  ///< empty if no bound is promised
  bool operator==(const HuntedError&) const = default;

  /// |excess| / bound, at least: by the ends of the enclosures that make it smallest. Empty without
  /// a bound, and for a bound of 0 (flat attributes, which are copies).
  std::optional<double> share() const;
  /// The quantity that guides the search; 0 if the value does not have it.
  double score(Guide guide) const;
  /// True unless the value is certainly within its bound.
  bool is_beyond_bound() const;
};

/// A case of the archive, with the value for which it is there.
struct HuntEntry {
  HuntedError error;
  cases::Case source;
  std::uint64_t step = 0;  ///< that made the case
  std::uint64_t root = 0;  ///< the step of the unmoved case that it descends from
  HuntSource made_by = HuntSource::random;
  std::vector<std::string_view> moves;  ///< of the last step, in order; names (case_moves.h)
  bool operator==(const HuntEntry&) const = default;
};

class HuntArchive {
 public:
  struct Niche {
    records::AttributeKind kind = records::AttributeKind::depth;
    records::Stratum stratum = records::Stratum::ordinary;
    auto operator<=>(const Niche&) const = default;
  };
  /// The most entries of a niche: several, so that a start that leads nowhere does not end the
  /// search, and few, so that each gets many steps.
  static constexpr std::size_t kMostEntries = 8;

  explicit HuntArchive(Guide guide) : guide_(guide) {}

  /// Keeps the entry in its niche if it is worse than one that has to go for it: the entry of the
  /// same root or, if there is none, the least bad of a full niche. Refuses values with a score of
  /// 0, and values beyond their bound. Returns true if the entry is kept.
  bool offer(HuntEntry entry);

  /// Chooses a parent: of two random niches, one of the niche whose latest moves were kept more
  /// often, and there bad entries likelier than less bad ones. Niches in which the bound itself has
  /// been found thus take few steps, and none is ever left out. Returns nullptr if the archive is
  /// empty.
  const HuntEntry* choose(Draw& draw) const;

  /// Notes whether the archive kept what a move of an entry of this niche led to, in any niche.
  void note(const Niche& niche, bool is_kept);

  /// The entries of each niche, the worst first; of equally bad ones, the earlier step first.
  const std::map<Niche, std::vector<HuntEntry>>& niches() const { return niches_; }
  bool operator==(const HuntArchive&) const = default;

 private:
  /// What the latest moves of a niche's entries led to.
  struct Progress {
    std::uint64_t made = 0;
    std::uint64_t kept = 0;
    bool operator==(const Progress&) const = default;
  };
  /// The share of moves kept, as if one more had been kept and one not: new niches look good.
  double promise_of(const Niche& niche) const;

  Guide guide_;
  std::map<Niche, std::vector<HuntEntry>> niches_;
  std::map<Niche, Progress> progress_;
};

struct HuntPlan {
  std::string law;      ///< id
  std::string backend;  ///< specification
  std::uint64_t seed = 0;
  std::uint64_t steps = 0;
  Guide guide = Guide::share;
  /// False for a comparison: every step checks a random case, and nothing guides.
  bool is_guided = true;
  /// Cases that the first steps check, one each. A hunt that is not guided has none of them.
  std::vector<cases::Case> given;
  bool fail_fast = false;  ///< the first violation that is not known ends the hunt with its round
  cases::Capabilities capabilities;  ///< of the backend (capabilities_of)
};

/// Steps per round. More would let more processes work at once, but guide the search less often.
inline constexpr std::uint64_t kStepsPerRound = 64;

/// How often a move was made, and how often the changed case entered the archive. A step with
/// several moves counts for each.
struct MoveCounts {
  std::uint64_t made = 0;
  std::uint64_t kept = 0;
  bool operator==(const MoveCounts&) const = default;
};

struct HuntOutcome {
  std::uint64_t steps = 0;  ///< done, in whole rounds
  std::map<HuntSource, std::uint64_t> sources;
  /// Cases to which the law did not apply or that the backend refused, by reason.
  std::map<std::string, std::uint64_t> not_applicable_because;
  std::uint64_t checked = 0;
  std::uint64_t violations = 0;   ///< cases with violations that are not known
  std::uint64_t known = 0;        ///< cases with known violations only
  std::uint64_t not_of_case = 0;  ///< worst errors of changed versions of a case, not compared
  std::map<std::string_view, MoveCounts> moves;
  HuntArchive archive{Guide::share};
  /// Of violations that are not known: the first of each way to fail. `found->index` is the step.
  std::vector<records::Counterexample> counterexamples;
  std::optional<std::string> fault;  ///< of the oracle; if set, nothing else counts
  bool operator==(const HuntOutcome&) const = default;
};

/// Searches. `backend` must draw like the backends that `execute` checks cases with; it is asked
/// for contracts only. If `execute` ends before all tasks of a round are done, the hunt ends with
/// the round before. `progress` is called after each round.
Result<HuntOutcome> hunt(const HuntPlan& plan, const std::vector<cases::Case>& corpus,
                         const backends::Backend& backend, const Execute& execute,
                         const Progress& progress = {});

/// An entry that was shrunk, and facts about its value.
struct HuntTrophy {
  HuntEntry entry;
  std::optional<records::Shrinking> shrinking;  ///< empty: not shrunk
  /// Condition numbers of the sample (oracle::Conditioning); empty for depths and flat values.
  std::optional<double> kappa;
  std::optional<double> kappa_d;
  /// The parts of the error by stage; empty if the value does not have them.
  std::optional<records::ErrorSplit> split;
  /// False if the case did not err as much when it was checked again: the backend's drawings vary.
  /// The entry is then as the hunt found it.
  bool errs_again = true;
};

/// Shrinks an entry as far as the score of a value in its niche stays at least as large, then
/// measures the value. The case gets `found`, so that `rastercheck replay` checks the law on the
/// backend.
HuntTrophy trophy_of(const Law& law, const HuntPlan& plan, const HuntEntry& entry,
                     backends::Backend& backend, const ShrinkLimits& limits,
                     const KnownDefects* known = nullptr);

}  // namespace rastercheck::properties
