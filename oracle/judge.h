#pragma once

// The judge: holds what a backend drew against the exact truth (RULES §2, §3, §5).
//
// Coverage. Every sample of every triangle is required, forbidden or permitted; what was drawn is
// then right, missing or extra. Nothing is close enough.
//
// Values. The contract leaves a value open within a range [lo, hi], mostly of one point. The
// *excess* of a computed f is
//
//   (f − hi)/ulp where f > hi,   (f − lo)/ulp where f < lo,   0 between,
//
// in scale ULP (oracle/ulp.h) of the end it lies beyond; it is held against the contract's bound.
// The *ideal* error is (f − r)/ulp, r the value there of the triangle that the contract's basis
// names, the exact one or that of snapped vertices; of the exact one where the basis leaves
// several; as the rules interpolate, whatever the contract claims. It says how precise the backend
// is, whatever its contract leaves open. Both are
// certified, and decided exactly in the last resort; none is left undecided.
//
// What is no number is a class. An infinite f counts as ±2^128, the number after the largest
// float32, and is right where the exact value lies beyond that or the bound reaches it.
//
// Not judged: values that the rules leave free (TriangleTruth::is_value_free) or undefined.
//
// With the case's depth test, fragments are those of for_each_fragment (oracle/fragments.h), but
// which of two is nearer is open where their depths, moved by the contract's bound, overlap.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cases/fragments.h"
#include "cases/sample_place.h"
#include "oracle/level.h"
#include "oracle/triangle_truth.h"
#include "records/judgement.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// How one value of a fragment came out.
struct JudgedValue {
  records::AttributeKind kind = records::AttributeKind::depth;
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; nothing for depth
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  float actual = 0;
  /// Scale ULP, certified, as narrow as the class and the histogram needed; nothing of what is no
  /// finite number.
  std::optional<records::Enclosure> excess;
  std::optional<records::Enclosure> ideal;  ///< also nothing where that triangle has none
};

/// How one sample of one triangle came out, of those that were drawn or are missing.
struct JudgedSample {
  cases::SamplePlace place = {};
  records::SampleVerdict decision;
  /// correct, missing, extra or wrong_triangle
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  std::vector<JudgedValue> values;  ///< only of correct ones; depth first, then the attributes
};

/// Takes judged samples, with the truth of their triangle; nullptr where one names a triangle that
/// the case does not have. Both live no longer than the call. Samples come in their order: by
/// triangle, y, x, sample; with a depth test by y, x, sample, triangle.
using JudgeSink = std::function<void(const JudgedSample&, const TriangleTruth*)>;

struct JudgeOptions {
  bool judges_values = true;     ///< else coverage only
  std::uint64_t case_index = 0;  ///< for WorstError
  /// One in so many fragments is held against the referee, which takes a thousand times as long; of
  /// 0 none.
  std::uint64_t self_check_one_in = 16384;
  /// Whether the sink is handed samples of which there is nothing to say: strictly inside, drawn,
  /// and all values right.
  bool shows_ordinary = true;
  /// What answers first; all give the same answers, each slower than the one before.
  Level first_level = Level::filter;
  unsigned jobs = 1;  ///< threads; the result is the same for any number
};

struct JudgedDrawing {
  records::Judgement judgement;
  /// A difference between oracle and referee: a fault of the oracle, whose answers are then worth
  /// nothing. One line.
  std::optional<std::string> fault;
  /// The triangles that had a sample drawn rightly, or missing; ascending.
  std::vector<std::uint32_t> seen_triangles;
};

/// Judges by the scene's contract. What was drawn may be anything: fragments that name no triangle,
/// pixel or sample of the case, or that come twice, are `extra`; their order does not matter.
JudgedDrawing judge(const SceneTruth& scene, const cases::Fragments& drawn,
                    const JudgeOptions& options = {}, const JudgeSink& sink = {});

}  // namespace rastercheck::oracle
