#include "properties/campaign/internal/hunted_errors.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "cases/fragments.h"
#include "oracle/judge.h"
#include "oracle/stage_split.h"
#include "oracle/transform.h"
#include "oracle/triangle_truth.h"
#include "records/record.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using records::AttributeKind;
using records::ErrorStatistics;
using records::WorstError;

/// The case with one pixel and at most one attribute, so that judging it judges one value of each
/// sample. A scissor and other attributes change no value; without a depth test, no fragment hides
/// another.
Case with_one_value(const Case& c, const WorstError& worst) {
  Case one = c;
  one.scissor =
      cases::Scissor{static_cast<int>(worst.place.x), static_cast<int>(worst.place.y), 1, 1};
  one.depth_test = cases::DepthTest::none;
  one.attributes.clear();
  one.attribute_values.clear();
  if (!worst.attribute) return one;
  one.attributes = {c.attributes[*worst.attribute]};
  for (std::size_t vertex = 0; vertex < c.positions.size(); ++vertex) {
    one.attribute_values.push_back(c.attributes_of(vertex)[*worst.attribute]);
  }
  return one;
}

/// A drawing of a single fragment with the computed value.
cases::Fragments with_one_fragment(const WorstError& worst) {
  cases::Fragments drawn;
  drawn.triangle = {worst.place.triangle};
  drawn.x = {static_cast<std::uint16_t>(worst.place.x)};
  drawn.y = {static_cast<std::uint16_t>(worst.place.y)};
  drawn.sample = {static_cast<std::uint8_t>(worst.place.sample)};
  drawn.depth = {worst.attribute ? 0 : worst.actual};
  if (!worst.attribute) return drawn;
  drawn.attribute_count = 1;
  drawn.attributes = {worst.actual};
  return drawn;
}

/// Judges single values of a case.
class ValueJudge {
 public:
  ValueJudge(const Case& c, const cases::Contract& contract)
      : case_(&c), contract_(&contract), scene_(c, contract) {}

  /// Returns the errors of a value; empty if the case has no such value.
  std::optional<HuntedError> judge(AttributeKind kind, const WorstError& worst) {
    const bool exists = worst.place.triangle < case_->triangles.size() &&
                        (!worst.attribute || *worst.attribute < case_->attributes.size());
    if (!exists) return std::nullopt;
    const oracle::SceneTruth alone(with_one_value(*case_, worst), *contract_);
    oracle::JudgeOptions options;
    options.self_check_one_in = 0;
    const oracle::JudgedDrawing judged = oracle::judge(alone, with_one_fragment(worst), options);
    const auto found = judged.judgement.errors.find(kind);
    if (found == judged.judgement.errors.end()) return std::nullopt;
    const ErrorStatistics& statistics = found->second;
    HuntedError error;
    error.kind = kind;
    error.at = worst.place;
    error.attribute = worst.attribute;
    error.actual = worst.actual;
    error.exact = worst.exact;
    if (statistics.strata.empty()) {
      // The value has no ideal error, so the judge does not count it in a stratum.
      error.stratum =
          oracle::StageSplit(*case_, *case_, *contract_, worst.place.triangle).stratum();
    } else {
      const auto& [stratum, sizes] = *statistics.strata.begin();
      error.stratum = stratum;
      if (const WorstError* const ideal = records::worst_of(sizes.extremes)) {
        error.ideal = ideal->error;
      }
    }
    if (const WorstError* const excess = records::worst_of(statistics.excess.extremes)) {
      error.excess = excess->error;
    }
    error.bound = bound_of(worst);
    return error;
  }

 private:
  std::optional<records::Enclosure> bound_of(const WorstError& worst) {
    auto& truth = truths_[worst.place.triangle];
    if (!truth) truth = std::make_unique<oracle::TriangleTruth>(scene_, worst.place.triangle);
    const auto bound = truth->value_bound(
        worst.attribute ? std::optional<std::size_t>(*worst.attribute) : std::nullopt,
        static_cast<int>(worst.place.x), static_cast<int>(worst.place.y),
        static_cast<int>(worst.place.sample));
    if (!bound) return std::nullopt;
    return bound->enclosure();
  }

  const Case* case_;
  const cases::Contract* contract_;
  oracle::SceneTruth scene_;
  std::map<std::uint32_t, std::unique_ptr<oracle::TriangleTruth>> truths_;
};

/// True if both describe the same value.
bool is_same_value(const HuntedError& error, const WorstError& worst) {
  return error.at == worst.place && error.attribute == worst.attribute;
}

}  // namespace

HuntedErrors hunted_errors(const Case& c, const cases::Contract& contract,
                           const std::map<AttributeKind, ErrorStatistics>& found) {
  HuntedErrors errors;
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (!clip) return errors;
  std::optional<ValueJudge> judge;  // made for the first value
  const auto add = [&](AttributeKind kind, const WorstError* worst, bool is_excess) {
    if (worst == nullptr) return;
    const bool is_there = std::any_of(
        errors.all.begin(), errors.all.end(),
        [&](const HuntedError& one) { return one.kind == kind && is_same_value(one, *worst); });
    if (is_there) return;
    if (!judge) judge.emplace(*clip, contract);
    std::optional<HuntedError> error = judge->judge(kind, *worst);
    const bool is_same = error && (is_excess ? error->excess : error->ideal) == worst->error;
    if (is_same) {
      errors.all.push_back(*std::move(error));
    } else {
      ++errors.not_of_case;
    }
  };
  for (const auto& [kind, statistics] : found) {
    // Errors of stored depths are counted in steps of their format, and bounds in ULP.
    if (kind == AttributeKind::depth && c.depth_format != cases::DepthFormat::float32) continue;
    for (const auto& [stratum, sizes] : statistics.strata) {
      add(kind, records::worst_of(sizes.extremes), false);
    }
    add(kind, records::worst_of(statistics.excess.extremes), true);
  }
  return errors;
}

}  // namespace rastercheck::properties
