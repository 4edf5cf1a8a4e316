#pragma once

// The judge: compares a backend's drawing with the exact truth (RULES §2, §3, §5).
//
// Coverage. Every sample of every triangle is required, forbidden or permitted. A drawing is wrong
// if it lacks a required sample (missing) or has a forbidden one (extra). No tolerance applies.
//
// Values. The contract allows a range [lo, hi] for a value, usually a single point. The *excess* of
// a computed f is
//
//   (f − hi)/ulp if f > hi,   (f − lo)/ulp if f < lo,   0 between,
//
// in scale ULP (oracle/ulp.h) of the end that f lies beyond; the excess must not exceed the
// contract's bound. The *ideal* error is (f − r)/ulp. r is the value of the triangle that the
// contract's basis names, exact or snapped (exact if the basis allows several triangles). It is
// interpolated as the rules say, even if the contract claims otherwise. The ideal error says how
// precise the backend is, regardless of what its contract leaves open. Both errors are certified
// enclosures. Where an enclosure cannot decide, exact numbers do, so no value is left undecided.
//
// NaN and a wrongly infinite f have classes of their own. An infinite f counts as ±2^128, the
// number after the largest float32, and is right if the exact value lies beyond ±2^128 or the bound
// reaches ±2^128.
//
// Not judged: values that the rules leave free (TriangleTruth::is_value_free) or undefined.
//
// With the case's depth test, the fragments are those of for_each_fragment (oracle/fragments.h). If
// the depths of two fragments overlap once each is widened by the contract's bound, either may be
// the nearer one.

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

/// The judgement of one value of a fragment.
struct JudgedValue {
  records::AttributeKind kind = records::AttributeKind::depth;
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; empty for depth
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  float actual = 0;
  /// Certified, in scale ULP, and only as narrow as the class and the histogram require. Empty if
  /// `actual` is not finite.
  std::optional<records::Enclosure> excess;
  std::optional<records::Enclosure> ideal;  ///< also empty for a centroid, and if the triangle of
                                            ///< the basis has no value
};

/// The judgement of one sample of one triangle. The sample was drawn, or it is missing.
struct JudgedSample {
  cases::SamplePlace place = {};
  records::SampleVerdict decision;
  /// correct, missing, extra or wrong_triangle
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  /// Depth first, then the attributes; empty unless the sample is correct.
  std::vector<JudgedValue> values;
};

/// Receives judged samples, each with the truth of its triangle (nullptr if the case has no such
/// triangle). The sample and the truth are valid only during the call. Order: by triangle, y, x,
/// sample; with a depth test by y, x, sample, triangle.
using JudgeSink = std::function<void(const JudgedSample&, const TriangleTruth*)>;

struct JudgeOptions {
  bool judges_values = true;     ///< else coverage only
  std::uint64_t case_index = 0;  ///< copied into each WorstError
  /// One fragment in this many is compared with the referee, which takes a thousand times as long;
  /// 0 means none.
  std::uint64_t self_check_one_in = 16384;
  /// True if the sink also receives unremarkable samples: strictly inside, drawn, all values right.
  bool shows_ordinary = true;
  /// The level that the cascade starts with. All levels give the same answers; each is slower than
  /// the one before.
  Level first_level = Level::filter;
  unsigned jobs = 1;  ///< threads; the result is the same for any number
};

struct JudgedDrawing {
  records::Judgement judgement;
  /// One line describing a difference between oracle and referee, if one was found. It proves a
  /// fault of the oracle, so the oracle's answers are worthless.
  std::optional<std::string> fault;
  /// Triangles that have a correctly drawn or a missing sample, in ascending order.
  std::vector<std::uint32_t> seen_triangles;
};

/// Judges a drawing by the scene's contract. `drawn` may hold anything, in any order: fragments
/// that name no triangle, pixel or sample of the case, and duplicates, are `extra`.
JudgedDrawing judge(const SceneTruth& scene, const cases::Fragments& drawn,
                    const JudgeOptions& options = {}, const JudgeSink& sink = {});

}  // namespace rastercheck::oracle
