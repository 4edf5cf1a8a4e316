#include "properties/inspect/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "cases/exact_contract.h"
#include "cases/sample_pattern.h"
#include "oracle/stage_split.h"
#include "oracle/triangle_truth.h"
#include "oracle/ulp.h"
#include "properties/inspect/crop.h"
#include "properties/inspect/elided.h"
#include "properties/inspect/outline.h"

namespace rastercheck::properties {
namespace {

using oracle::PixelBox;
using oracle::Rational;
using oracle::SceneTruth;
using oracle::TriangleTruth;
using oracle::ValueRange;
using records::Enclosure;
using records::InspectedSample;
using records::InspectedValue;
using records::Inspection;
using records::Verdict;

/// The drawn fragments of one triangle, by (y, x, sample): indices into the fragments.
using FragmentIndex =
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::size_t>;

FragmentIndex fragments_of(const cases::Fragments& all, std::uint32_t triangle) {
  FragmentIndex drawn;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all.triangle[i] == triangle)
      drawn.emplace(std::tuple(all.y[i], all.x[i], all.sample[i]), i);
  }
  return drawn;
}

/// One triangle of a drawing, with its exact and its promised version.
struct InspectedDrawing {
  const cases::Case* c;
  const TriangleTruth* exact;     ///< of the exact triangle
  const TriangleTruth* promised;  ///< of the triangle that the contract promises
  const cases::Fragments* framebuffer;
  FragmentIndex drawn;

  std::optional<std::size_t> fragment_at(std::uint32_t x, std::uint32_t y,
                                         std::uint32_t sample) const {
    const auto found = drawn.find({y, x, sample});
    if (found == drawn.end()) return std::nullopt;
    return found->second;
  }
};

// --- Values --------------------------------------------------------------------------------------

/// Returns the magnitude to which scale ULP refer (RULES §5).
Rational magnitude_of(const InspectedDrawing& subject, std::optional<std::uint32_t> attribute) {
  if (attribute) return subject.exact->attribute_magnitude(*attribute);
  const cases::Viewport& v = subject.c->viewport;
  return Rational(std::max(std::abs(v.min_depth), std::abs(v.max_depth)));
}

std::optional<ValueRange> value_at(const TriangleTruth& truth,
                                   std::optional<std::uint32_t> attribute, int x, int y,
                                   int sample) {
  return attribute ? truth.attribute(*attribute, x, y, sample) : truth.depth(x, y, sample);
}

/// Returns the end of the range that the value exceeds; empty if the value is inside.
std::optional<Rational> passed_end(float computed, const ValueRange& range) {
  const Rational value(computed);
  if (value > range.hi) return range.hi;
  if (value < range.lo) return range.lo;
  return std::nullopt;
}

Enclosure scale_error(float computed, const ValueRange& range, const Rational& magnitude) {
  const std::optional<Rational> end = passed_end(computed, range);
  return end ? oracle::scale_ulp_error(computed, *end, magnitude) : Enclosure();
}

Enclosure local_error(float computed, const ValueRange& range) {
  const std::optional<Rational> end = passed_end(computed, range);
  return end ? oracle::local_ulp_error(computed, *end) : Enclosure();
}

/// The distance of a depth in a unorm format from a range, in steps of the format. Both ends of the
/// enclosure are off by less than 2^-27, as a depth in double is by 2^-53.
Enclosure steps_error(float computed, const ValueRange& range, int bits) {
  const double steps = std::ldexp(1.0, bits) - 1;
  const double stored = std::round(double{computed} * steps);
  const double below = range.lo.nearest_double() * steps;
  const double above = range.hi.nearest_double() * steps;
  const double error = stored - std::clamp(stored, below, above);
  constexpr double kSlack = 0x1p-27;
  return error == 0 ? Enclosure() : Enclosure{error - kSlack, error + kSlack};
}

/// Returns the double nearest to a single value, or the middle of a range's rounded ends.
double middle_of(const ValueRange& range) {
  if (range.lo == range.hi) return range.lo.nearest_double();
  return range.lo.nearest_double() / 2 + range.hi.nearest_double() / 2;
}

void add_errors(const InspectedDrawing& subject, const std::optional<ValueRange>& exact,
                const InspectedSample& at, const Rational& magnitude, InspectedValue& value) {
  if (!value.actual || !std::isfinite(*value.actual)) return;
  const int bits = value.attribute ? 0 : cases::unorm_bits(subject.c->depth_format);
  const auto error_in = [&](const ValueRange& range) {
    return bits != 0 ? steps_error(*value.actual, range, bits)
                     : scale_error(*value.actual, range, magnitude);
  };
  if (exact) {
    value.scale_error = error_in(*exact);
    value.local_error = local_error(*value.actual, *exact);
  }
  const bool is_free = value.attribute && subject.promised->is_value_free(*value.attribute);
  if (at.verdict == Verdict::forbidden || is_free) return;
  const std::optional<ValueRange> promised =
      value_at(*subject.promised, value.attribute, static_cast<int>(at.place.x),
               static_cast<int>(at.place.y), static_cast<int>(at.place.sample));
  if (promised) value.excess = error_in(*promised);
}

InspectedValue inspect_value(const InspectedDrawing& subject,
                             std::optional<std::uint32_t> attribute, const InspectedSample& at,
                             std::optional<std::size_t> fragment) {
  const auto x = static_cast<int>(at.place.x);
  const auto y = static_cast<int>(at.place.y);
  const auto sample = static_cast<int>(at.place.sample);
  InspectedValue value;
  value.attribute = attribute;
  if (fragment) {
    value.actual = attribute ? subject.framebuffer->attributes_of(*fragment)[*attribute]
                             : subject.framebuffer->depth[*fragment];
  }
  const std::optional<ValueRange> exact = value_at(*subject.exact, attribute, x, y, sample);
  if (exact) {
    value.exact = elided(*exact);
    value.nearest = middle_of(*exact);
  }
  add_errors(subject, exact, at, magnitude_of(subject, attribute), value);
  // A range has no single place at which to evaluate the conditioning.
  if (!attribute || !exact || exact->lo != exact->hi) return value;
  if (const auto condition = subject.exact->conditioning(*attribute, x, y, sample)) {
    if (condition->kappa) value.kappa = condition->kappa->enclosure();
    if (condition->kappa_d) value.kappa_d = condition->kappa_d->enclosure();
  }
  return value;
}

InspectedSample inspect_sample(const InspectedDrawing& subject, std::uint32_t x, std::uint32_t y,
                               std::uint32_t sample) {
  const auto column = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  const auto number = static_cast<int>(sample);
  const records::SampleVerdict decision = subject.promised->judge(column, row, number);
  InspectedSample found;
  found.place.x = x;
  found.place.y = y;
  found.place.sample = sample;
  found.verdict = decision.verdict;
  found.reason = decision.reason;
  found.distance = subject.promised->distance(column, row, number);
  if (const auto edges = subject.exact->edges(column, row, number)) {
    found.edges = {(*edges)[0].enclosure(), (*edges)[1].enclosure(), (*edges)[2].enclosure()};
  }
  const std::optional<std::size_t> fragment = subject.fragment_at(x, y, sample);
  found.is_drawn = fragment.has_value();
  if (!fragment && decision.verdict == Verdict::forbidden) return found;
  found.values.push_back(inspect_value(subject, std::nullopt, found, fragment));
  for (std::uint32_t a = 0; a < subject.c->attributes.size(); ++a) {
    found.values.push_back(inspect_value(subject, a, found, fragment));
  }
  return found;
}

// --- The part that is shown ----------------------------------------------------------------------

/// Returns the pixels to show.
PixelBox crop_of(const InspectedDrawing& subject, const cases::SamplePlace& at,
                 const InspectOptions& options) {
  const auto x = static_cast<int>(at.x);
  const auto y = static_cast<int>(at.y);
  PixelBox touched = hull(subject.promised->pixels(), {x, y, x + 1, y + 1});
  for (const auto& [place, fragment] : subject.drawn) {
    const auto column = static_cast<int>(std::get<1>(place));
    const auto row = static_cast<int>(std::get<0>(place));
    touched = hull(touched, {column, row, column + 1, row + 1});
  }
  return crop_around(*subject.c, touched, at, options.most_values);
}

void inspect_crop(const InspectedDrawing& subject, const PixelBox& crop, Inspection& inspection) {
  inspection.left = static_cast<std::uint32_t>(crop.x0);
  inspection.top = static_cast<std::uint32_t>(crop.y0);
  inspection.width = static_cast<std::uint32_t>(crop.x1 - crop.x0);
  inspection.height = static_cast<std::uint32_t>(crop.y1 - crop.y0);
  const auto samples = static_cast<std::uint32_t>(subject.c->framebuffer.samples);
  for (std::uint32_t y = 0; y < inspection.height; ++y) {
    for (std::uint32_t x = 0; x < inspection.width; ++x) {
      for (std::uint32_t s = 0; s < samples; ++s) {
        inspection.samples.push_back(
            inspect_sample(subject, inspection.left + x, inspection.top + y, s));
      }
    }
  }
}

/// Fills in what is the same for all samples.
Inspection begin_inspection(const SceneTruth& scene, const Focus& focus,
                            const TriangleTruth& exact) {
  const cases::Case& c = scene.source();
  Inspection inspection;
  inspection.source = c;
  const auto& own = scene.contract().sample_position;
  if (own && c.framebuffer.samples == 1) {
    const double parts = own->parts;
    inspection.pattern.push_back({own->x / parts, own->y / parts});
  } else {
    for (const cases::SamplePosition& p : cases::standard_pattern(c.framebuffer.samples)) {
      inspection.pattern.push_back({p.x / 16.0, p.y / 16.0});
    }
  }
  inspection.place.triangle = focus.at.triangle;
  inspection.place.x = focus.at.x;
  inspection.place.y = focus.at.y;
  inspection.place.sample = focus.at.sample;
  inspection.attribute = focus.attribute;
  if (const std::optional<oracle::QMatrix> q = exact.q_matrix()) {
    inspection.q_matrix.emplace();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) (*inspection.q_matrix)[i][k] = elided((*q)[i][k]);
    }
  }
  for (std::size_t triangle = 0; triangle < c.triangles.size(); ++triangle) {
    inspection.outlines.push_back(outline_of(scene, triangle));
  }
  return inspection;
}

// --- How the sample came about -------------------------------------------------------------------

/// Splits the errors of the sample in focus by the backend's trace. Without a trace of the drawn
/// value, splits them as far as is possible for any backend.
void add_splits(const cases::ClipCase& c, const cases::Contract& contract, const TracedSample& told,
                Inspection& inspection) {
  const auto& [triangle, y, x, number] = inspection.place;
  const InspectedSample* sample = inspected_sample(inspection);
  if (sample == nullptr) return;
  const records::SampleTrace* const trace = told && *told ? &**told : nullptr;
  const oracle::StageSplit split(c.given(), c, contract, triangle);
  for (const InspectedValue& value : sample->values) {
    if (!value.actual) continue;
    std::optional<oracle::ExactSplit> parts;
    if (trace) parts = split.traced(value.attribute, x, y, number, *value.actual, *trace);
    if (!parts) parts = split.untraced(value.attribute, x, y, number, *value.actual);
    if (parts) inspection.splits.push_back(oracle::enclose(*parts));
  }
  if (told) inspection.coverage_stage = split.coverage_stage(x, y, number, sample->is_drawn, trace);
}

/// True if a crop lies inside the framebuffer and contains the focus.
bool has(const PixelBox& crop, const cases::FramebufferSize& size, const Focus& focus) {
  const auto x = static_cast<int>(focus.at.x);
  const auto y = static_cast<int>(focus.at.y);
  return crop.x0 >= 0 && crop.x1 <= size.width && crop.y0 >= 0 && crop.y1 <= size.height &&
         x >= crop.x0 && x < crop.x1 && y >= crop.y0 && y < crop.y1;
}

Result<void> check_focus(const cases::Case& c, const Focus& focus, const InspectOptions& options) {
  const auto refuse = [](std::string reason) {
    return tl::unexpected(Error{"", "", std::move(reason)});
  };
  const auto& [triangle, y, x, sample] = focus.at;
  const cases::FramebufferSize& size = c.framebuffer;
  if (triangle >= c.triangles.size()) {
    return refuse(
        fmt::format("triangle {} does not exist; the case has {}", triangle, c.triangles.size()));
  }
  if (std::cmp_greater_equal(x, size.width) || std::cmp_greater_equal(y, size.height)) {
    return refuse(fmt::format("pixel ({}, {}) lies outside the framebuffer of {} × {} pixels", x, y,
                              size.width, size.height));
  }
  if (std::cmp_greater_equal(sample, size.samples)) {
    return refuse(fmt::format("sample {} does not exist; a pixel has {}", sample, size.samples));
  }
  if (focus.attribute && *focus.attribute >= c.attributes.size()) {
    return refuse(fmt::format("attribute {} does not exist; the case has {}", *focus.attribute,
                              c.attributes.size()));
  }
  if (options.crop && !has(*options.crop, size, focus)) {
    return refuse("the part that is shown has no such pixel");
  }
  return {};
}

}  // namespace

Result<Inspection> inspect(const cases::ClipCase& c, const backends::Drawn& drawn,
                           const Focus& focus, const TracedSample& trace,
                           const InspectOptions& options) {
  if (const Result<void> is_there = check_focus(c, focus, options); !is_there) {
    return tl::unexpected(is_there.error());
  }
  const SceneTruth exact_scene(c, cases::exact_contract(cases::contract_of(c)));
  const SceneTruth promised_scene(c, drawn.contract);
  const TriangleTruth exact(exact_scene, focus.at.triangle);
  const TriangleTruth promised(promised_scene, focus.at.triangle);
  const InspectedDrawing subject{&c, &exact, &promised, &drawn.fragments,
                                 fragments_of(drawn.fragments, focus.at.triangle)};
  Inspection inspection = begin_inspection(exact_scene, focus, exact);
  const PixelBox crop = options.crop ? *options.crop : crop_of(subject, focus.at, options);
  inspect_crop(subject, crop, inspection);
  add_splits(c, drawn.contract, trace, inspection);
  return inspection;
}

}  // namespace rastercheck::properties
