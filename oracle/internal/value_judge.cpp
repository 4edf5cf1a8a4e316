#include "oracle/internal/value_judge.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/internal/rational_number.h"
#include "oracle/internal/stored_depth.h"
#include "oracle/internal/value_bound.h"
#include "oracle/internal/value_errors.h"
#include "records/record.h"

namespace rastercheck::oracle {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// The x, y and sample of a value's place.
std::array<int, 3> sample_of(const ComputedValue& value) {
  return {static_cast<int>(value.place.x), static_cast<int>(value.place.y),
          static_cast<int>(value.place.sample)};
}

/// True if the contract promises on which side depths lie, and the value is a depth.
bool is_depth_of_one_side(const TriangleTruth& truth, const ComputedValue& value) {
  return !value.attribute &&
         truth.setup().scene->contract().depth_error != cases::DepthError::either_side;
}

/// True if a depth that is off by `excess`, which is not 0, lies on the side that the contract
/// excludes.
bool is_on_wrong_side(const UlpError& excess, const TriangleTruth& truth) {
  const cases::Contract& contract = truth.setup().scene->contract();
  const bool is_less = sign_of(excess.value()) < 0;
  const bool is_nearer = is_less != contract.is_depth_reversed();
  return is_nearer == (contract.depth_error == cases::DepthError::never_nearer);
}

/// Decides exactly whether |excess| is within the contract's bound; empty if the contract promises
/// nothing there.
std::optional<bool> is_within(const UlpError& excess, const TriangleTruth& truth,
                              const ComputedValue& value) {
  if (excess.is_zero()) return true;
  const bool is_one_sided = is_depth_of_one_side(truth, value);
  if (is_one_sided && is_on_wrong_side(excess, truth)) return false;
  const cases::ValueBound bound = bound_of(truth.setup(), value.attribute);
  const bool is_plain = value.attribute || truth.setup().scene->unorm_bits() == 0;
  if (is_plain && records::magnitude_bound(excess.enclosure()) <= double{bound.constant}) {
    return true;
  }
  const auto [x, y, sample] = sample_of(value);
  const std::optional<Rational> most = truth.value_bound(value.attribute, x, y, sample);
  // Nothing is promised on the other side then.
  if (!most && is_one_sided) return true;
  if (!most) return std::nullopt;
  return magnitude(excess.value()) <= to_field(*most);
}

bool is_flat(const cases::Case& source, const ComputedValue& value) {
  return value.attribute &&
         source.attributes[*value.attribute].interpolation == cases::Interpolation::flat;
}

/// True if all three vertices have the same zero and the value is the zero of the other sign.
bool is_other_zero(const cases::Case& source, const ComputedValue& value) {
  if (!value.attribute || value.actual != 0) return false;
  const cases::Triangle& triangle = source.triangles[value.place.triangle];
  return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
    const float at_vertex = source.attributes_of(vertex)[*value.attribute];
    return at_vertex == 0 && std::signbit(at_vertex) != std::signbit(value.actual);
  });
}

FragmentClass class_of(const SceneTruth& scene, const ComputedValue& value, const UlpError& excess,
                       bool is_right) {
  if (std::isinf(value.actual)) {
    // An infinity counts as ±2^128, and is right if the exact value lies beyond that.
    const records::Enclosure error = excess.enclosure();
    const bool lies_farther = value.actual > 0 ? error.hi < 0 : error.lo > 0;
    return is_right || lies_farther ? FragmentClass::correct : FragmentClass::infinite;
  }
  if (!is_right) return FragmentClass::beyond_bound;
  const bool keeps_sign = scene.contract().keeps_sign_of_zero || is_flat(scene.source(), value);
  return keeps_sign && is_other_zero(scene.source(), value) ? FragmentClass::wrong_sign_of_zero
                                                            : FragmentClass::correct;
}

/// Counts an error in the bucket of its exact magnitude.
void count(records::Histogram& histogram, const UlpError& error) {
  const records::Enclosure rough = error.enclosure();
  const auto lower =
      records::Histogram::bucket_of(std::min(std::abs(rough.lo), std::abs(rough.hi)));
  const auto upper = records::Histogram::bucket_of(records::magnitude_bound(rough));
  if (lower == upper) {
    histogram.add_to_bucket(lower, 1);
  } else {
    histogram.add(records::magnitude_bound(enclose(error.value())));
  }
}

/// Keeps an error if it is an extreme. `exact` returns the exact value's text.
template <typename Text>
void keep(records::ErrorSizes& sizes, const UlpError& error, const SceneTruth& scene,
          const ComputedValue& value, std::uint64_t case_index, const Text& exact) {
  if (!records::may_keep(sizes.extremes, error.enclosure())) return;
  records::WorstError worst;
  worst.error = enclose(error.value());
  // Tests again with the tighter enclosure, to save the work that follows.
  if (!records::may_keep(sizes.extremes, worst.error)) return;
  worst.exact = exact();
  worst.actual = value.actual;
  worst.case_index = case_index;
  worst.case_name = scene.source().name;
  worst.place = value.place;
  worst.attribute = value.attribute;
  records::keep(sizes.extremes, worst);
}

/// Counts an error, and keeps it if it is an extreme.
template <typename Text>
void add(records::ErrorSizes& sizes, const UlpError& error, const SceneTruth& scene,
         const ComputedValue& value, std::uint64_t case_index, const Text& exact) {
  count(sizes.histogram, error);
  // If the enclosure straddles the limit up to which errors are summed, uses the tightest doubles,
  // so that the enclosure lies on the same side of the limit as the error.
  const records::Enclosure rough = error.enclosure();
  const bool is_open =
      (rough.lo < -records::SignedSum::kMost && rough.hi >= -records::SignedSum::kMost) ||
      (rough.lo <= records::SignedSum::kMost && rough.hi > records::SignedSum::kMost);
  sizes.sum.add(is_open ? enclose(error.value()) : rough);
  keep(sizes, error, scene, value, case_index, exact);
}

/// The exact value that an error of a depth in steps, or of any other value, refers to.
std::string text_of(const UlpError& error, const SceneTruth& scene, const ComputedValue& value) {
  const int bits = value.attribute ? 0 : scene.scene().unorm_bits();
  Field exact = error.exact().value();
  if (bits != 0) exact /= Field(steps_of(bits));
  return to_rational(exact).to_string();
}

/// True if the value is a finite depth and not one of the unorm format that the case asks for.
bool is_not_of_format(const SceneTruth& scene, const ComputedValue& value) {
  const int bits = value.attribute ? 0 : scene.scene().unorm_bits();
  return bits != 0 && std::isfinite(value.actual) && !stored_number(value.actual, bits);
}

std::optional<ValueError> errors_of(const TriangleTruth& truth, const ComputedValue& value) {
  const auto [x, y, sample] = sample_of(value);
  const int bits = value.attribute ? 0 : truth.setup().scene->unorm_bits();
  Ring computed = computed_ring(value.actual);
  if (bits != 0 && std::isfinite(value.actual)) {
    const double nearby = double{value.actual} * steps_of(bits);
    computed = Ring(stored_number(value.actual, bits).value_or(nearby));
  }
  return truth.errors().of(value.attribute, x, y, sample, computed);
}

std::optional<ValueRange> range_of(const TriangleTruth& truth, const ComputedValue& value) {
  const auto [x, y, sample] = sample_of(value);
  return value.attribute ? truth.attribute(*value.attribute, x, y, sample)
                         : truth.depth(x, y, sample);
}

}  // namespace

ComputedValue computed_value(const cases::Fragments& drawn, std::size_t fragment,
                             std::optional<std::uint32_t> attribute) {
  return {drawn.place_of(fragment), attribute,
          attribute ? drawn.attributes_of(fragment)[*attribute] : drawn.depth[fragment]};
}

AttributeKind kind_of(const cases::Case& source, std::optional<std::uint32_t> attribute) {
  if (!attribute) return AttributeKind::depth;
  return records::kind_of(source.attributes[*attribute].interpolation);
}

std::optional<JudgedValue> judge_value(const SceneTruth& scene, const TriangleTruth& truth,
                                       const ComputedValue& value, std::uint64_t case_index,
                                       records::Stratum stratum, bool is_single,
                                       ValueStatistics& statistics) {
  JudgedValue judged;
  judged.kind = kind_of(scene.source(), value.attribute);
  judged.attribute = value.attribute;
  judged.actual = value.actual;
  records::ErrorStatistics& of_kind = statistics.of(judged.kind);
  const auto not_judged = [&of_kind](records::NotJudged why) {
    ++of_kind.not_judged[why];
    return std::nullopt;
  };
  if (std::isnan(value.actual)) {
    const auto [x, y, sample] = sample_of(value);
    if (!range_of(truth, value)) return not_judged(records::NotJudged::undefined);
    if (!truth.value_bound(value.attribute, x, y, sample) && !is_depth_of_one_side(truth, value)) {
      return not_judged(records::NotJudged::without_bound);
    }
    judged.fragment_class = FragmentClass::not_a_number;
    ++of_kind.classes[judged.fragment_class];
    return judged;
  }

  const std::optional<ValueError> errors = errors_of(truth, value);
  if (!errors) return not_judged(records::NotJudged::undefined);
  const std::optional<bool> is_right = is_within(errors->excess, truth, value);
  if (!is_right) return not_judged(records::NotJudged::without_bound);
  judged.fragment_class =
      class_of(scene, value, errors->excess, *is_right && !is_not_of_format(scene, value));
  ++of_kind.classes[judged.fragment_class];
  if (std::isinf(value.actual)) return judged;

  const auto add_to = [&](records::ErrorSizes& sizes, const UlpError& error) {
    add(sizes, error, scene, value, case_index, [&] { return text_of(error, scene, value); });
  };
  judged.excess = errors->excess.enclosure();
  if (errors->ideal) judged.ideal = errors->ideal->enclosure();
  if (errors->ideal && is_single) {
    add_to(statistics.enclosed(judged.kind, stratum).sizes, *errors->ideal);
    return judged;
  }
  add(of_kind.excess, errors->excess, scene, value, case_index,
      [&] { return to_string(range_of(truth, value)); });
  if (errors->ideal) {
    add_to(of_kind.ideal, *errors->ideal);
    add_to(of_kind.strata[stratum], *errors->ideal);
  }
  return judged;
}

void settle_extremes(const SceneTruth& scene, const cases::Fragments& drawn,
                     std::uint64_t case_index, EnclosedErrors& errors) {
  std::optional<TriangleTruth> truth;
  std::optional<std::uint32_t> prepared;
  for (const ExtremeCandidate& candidate : errors.candidates()) {
    const ComputedValue value = computed_value(drawn, candidate.fragment, candidate.attribute);
    if (prepared != value.place.triangle) {
      truth.emplace(scene, value.place.triangle);
      prepared = value.place.triangle;
    }
    const std::optional<ValueError> error = errors_of(*truth, value);
    if (!error || !error->ideal) continue;  // cannot happen: the error was enclosed
    if (errors.meaning == Meaning::excess) {
      keep(errors.sizes, error->excess, scene, value, case_index,
           [&] { return to_string(range_of(*truth, value)); });
    } else {
      keep(errors.sizes, *error->ideal, scene, value, case_index,
           [&] { return text_of(*error->ideal, scene, value); });
    }
  }
  errors.settled();
}

}  // namespace rastercheck::oracle
