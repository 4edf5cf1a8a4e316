#include "oracle/stage_split.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "oracle/internal/depth_offset.h"
#include "oracle/internal/floating_point.h"
#include "oracle/internal/prepared_values.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/stage_forms.h"
#include "oracle/internal/stage_triangles.h"

namespace rastercheck::oracle {
namespace {

using records::SampleTrace;
using records::Stage;
using records::TracedValue;

const TracedValue* traced_value(const SampleTrace& trace, std::optional<std::uint32_t> attribute) {
  if (!trace.is_drawn) return nullptr;
  if (!attribute) return &trace.depth;
  return *attribute < trace.attributes.size() ? &trace.attributes[*attribute] : nullptr;
}

/// Collects a value's errors stage by stage.
class Steps {
 public:
  explicit Steps(Field exact) : value_(std::move(exact)) {}

  /// Takes the value after the next stage; without a value the stage is left out.
  void take(Stage stage, const std::optional<Field>& value) {
    if (!value) return;
    parts_.push_back({stage, to_rational(*value - value_)});
    value_ = *value;
  }
  std::vector<ExactSplit::Part> finish() { return std::move(parts_); }

 private:
  Field value_;
  std::vector<ExactSplit::Part> parts_;
};

/// The forms of one value after each stage, from the received positions to the set-up.
class SplitForms {
 public:
  SplitForms(const SampleTrace& trace, const TracedValue& value, const TriangleUnder& received,
             std::optional<std::uint32_t> attribute)
      : trace_(&trace), value_(&value), received_(&received), attribute_(attribute) {
    take(Stage::transform, vertices_of(received.setup()));
    const bool is_of_another_part = value.corners || value.snapped;
    if (!value.is_from_vertices) {
      take_corners(Stage::clip_space, is_of_another_part ? value.corners : trace.corners);
      take_corners(Stage::snap, is_of_another_part ? value.snapped : trace.snapped);
    }
    take_set_up();
  }

  const std::vector<std::pair<Stage, Form>>& all() const { return forms_; }
  /// The terms of the last stage's corners, from which the backend computed the value.
  const Terms& terms() const { return terms_; }

 private:
  void take(Stage stage, const Corners& corners) {
    terms_ = terms_of(corners, received_->setup(), attribute_);
    forms_.emplace_back(stage, form_of(corners, terms_));
  }
  void take_corners(Stage stage,
                    const std::optional<std::array<records::TracedCorner, 3>>& traced) {
    if (!traced) return;
    if (const auto corners = traced_corners(*traced, received_->scene.scene())) {
      take(stage, *corners);
    }
  }
  void take_set_up() {
    if (!trace_->frame) return;
    std::optional<Form> form;
    if (value_->numerator) {
      form = form_of(*value_->numerator, value_->denominator, *trace_->frame);
    } else if (value_->is_from_lines && trace_->lines) {
      form = form_of(*trace_->lines, *trace_->frame, terms_);
    }
    if (form) forms_.emplace_back(Stage::set_up, *std::move(form));
  }

  const SampleTrace* trace_;
  const TracedValue* value_;
  const TriangleUnder* received_;
  std::optional<std::uint32_t> attribute_;
  Terms terms_;
  std::vector<std::pair<Stage, Form>> forms_;
};

/// The depth bias of a plane of depths, of which `form` gives the depths.
std::optional<Field> own_offset(const Form& form, const Point& p, const TriangleSetup& triangle) {
  const Ring& pixel = triangle.scene->units_per_pixel();
  const std::optional<Field> here = form(p);
  const std::optional<Field> along_x = form({p.u + pixel, p.v});
  const std::optional<Field> along_y = form({p.u, p.v + pixel});
  if (!here || !along_x || !along_y) return std::nullopt;
  return offset_of_slopes(triangle, *along_x - *here, *along_y - *here);
}

/// Returns the value that exact arithmetic makes of the weights, the shares, or the numerator and
/// denominator traced at the place.
std::optional<Field> value_of_weights(const TracedValue& value, const Terms& terms) {
  if (value.weights) {
    const std::optional<Weights> weights = exact_weights(*value.weights);
    return weights ? terms.at(*weights) : std::nullopt;
  }
  if (value.shares) {
    const std::optional<Weights> shares = exact_weights(*value.shares);
    return shares ? terms.mean(*shares) : std::nullopt;
  }
  if (!value.numerator_at || !std::isfinite(*value.numerator_at)) return std::nullopt;
  const double denominator = value.denominator_at.value_or(1);
  if (!std::isfinite(denominator) || denominator == 0) return std::nullopt;
  return Field(*value.numerator_at) / Field(denominator);
}

}  // namespace

bool adds_up(const ExactSplit& split, float actual) {
  const DefaultFloatingPoint modes;
  Field sum(0);
  for (const ExactSplit::Part& part : split.parts) sum += to_field(part.error);
  return sum == exact_field(actual) - to_field(split.exact);
}

records::ErrorSplit enclose(const ExactSplit& split) {
  const DefaultFloatingPoint modes;
  const Field& unit = to_field(split.unit);
  records::ErrorSplit record;
  record.attribute = split.attribute;
  record.is_traced = split.is_traced;
  Field total(0);
  for (const ExactSplit::Part& part : split.parts) {
    const Field& error = to_field(part.error);
    record.parts.push_back({part.stage, enclose(error / unit)});
    total += error;
  }
  record.total = enclose(total / unit);
  return record;
}

StageSplit::StageSplit(const cases::Case& given, const cases::Case& drawn,
                       const cases::Contract& contract, std::uint32_t triangle) {
  const DefaultFloatingPoint modes;
  triangles_ = std::make_unique<const Triangles>(triangle_alone(given, triangle),
                                                 triangle_alone(drawn, triangle), contract);
}

StageSplit::~StageSplit() = default;

records::Stratum StageSplit::stratum() const { return stratum_of(triangles_->open.setup()); }

std::optional<ExactSplit> StageSplit::traced(std::optional<std::uint32_t> attribute,
                                             std::uint32_t x, std::uint32_t y, std::uint32_t sample,
                                             float actual, const SampleTrace& trace) const {
  const DefaultFloatingPoint modes;
  const TracedValue* value = traced_value(trace, attribute);
  if (value == nullptr || !std::isfinite(actual) ||
      std::bit_cast<std::uint32_t>(value->value) != std::bit_cast<std::uint32_t>(actual)) {
    return std::nullopt;
  }
  const std::optional<Point> taken = exact_point(value->u, value->v);
  const std::optional<cases::Case> source = received_case(trace, triangles_->drawn.scene.source());
  if (!taken || !source) return std::nullopt;
  const auto start = triangles_->start(attribute, static_cast<int>(x), static_cast<int>(y),
                                       static_cast<int>(sample), taken);
  if (!start) return std::nullopt;

  const bool is_unorm = !attribute && triangles_->drawn.scene.scene().unorm_bits() != 0;
  const auto clamped = [&](std::optional<Field> exact, const Field& offset) {
    if (exact) exact = triangles_->clamped(attribute, *exact + offset);
    return exact;
  };
  const Field none(0);
  Steps steps(start->value);
  if (!triangles_->copy_of(attribute)) {
    std::optional<TriangleUnder> other;
    if (source->positions != triangles_->drawn.scene.source().positions) {
      other.emplace(*source, triangles_->drawn.scene.contract());
    }
    const SplitForms forms(trace, *value, other ? *other : triangles_->drawn, attribute);
    // Traced planes and what they give have the bias in them; corners and lines have not.
    const bool has_set_up = forms.all().back().first == Stage::set_up;
    const bool has_planes = has_set_up && !value->is_from_lines;
    Field offset = Triangles::offset_of(triangles_->drawn, attribute);
    for (const auto& [stage, form] : forms.all()) {
      if (stage == Stage::set_up) break;
      steps.take(stage, clamped(form(start->place), offset));
    }
    if (!attribute && triangles_->drawn.scene.scene().has_depth_bias()) {
      const Form& corners = (forms.all().rbegin() + (has_set_up ? 1 : 0))->second;
      if (const auto own = own_offset(corners, start->place, triangles_->drawn.setup())) {
        offset = *own;
        steps.take(Stage::bias, clamped(corners(start->place), offset));
      }
    }
    const Form& last_form = forms.all().back().second;
    const Field& after_set_up = has_planes ? none : offset;
    if (has_set_up) steps.take(Stage::set_up, clamped(last_form(start->place), after_set_up));
    steps.take(Stage::coverage, clamped(last_form(*taken), after_set_up));
    steps.take(Stage::weights, clamped(value_of_weights(*value, forms.terms()),
                                       value->numerator_at ? none : offset));
  }
  const Field last = exact_field(actual);
  const bool is_told = value->evaluated && std::isfinite(*value->evaluated);
  if (is_told) steps.take(Stage::evaluation, Field(*value->evaluated));
  steps.take(is_unorm ? Stage::store : is_told ? Stage::rounding : Stage::evaluation, last);
  return ExactSplit{attribute, to_rational(start->value), triangles_->unit(attribute, start->value),
                    steps.finish(), true};
}

std::optional<ExactSplit> StageSplit::untraced(std::optional<std::uint32_t> attribute,
                                               std::uint32_t x, std::uint32_t y,
                                               std::uint32_t sample, float actual) const {
  const DefaultFloatingPoint modes;
  const auto px = static_cast<int>(x);
  const auto py = static_cast<int>(y);
  const auto ps = static_cast<int>(sample);
  if (!std::isfinite(actual)) return std::nullopt;
  const auto start = triangles_->start(attribute, px, py, ps, std::nullopt);
  if (!start) return std::nullopt;

  Steps steps(start->value);
  std::optional<Field> handed = triangles_->copy_of(attribute);
  if (!handed) handed = triangles_->drawn.value_at(attribute, start->place);
  if (handed) {
    const Field offset = Triangles::offset_of(triangles_->drawn, attribute);
    steps.take(Stage::transform, triangles_->clamped(attribute, *handed + offset));
  }
  const Field last = exact_field(actual);
  const TriangleTruth& truth = triangles_->open.truth;
  const std::optional<ValueRange> range =
      attribute ? truth.attribute(*attribute, px, py, ps) : truth.depth(px, py, ps);
  const bool is_free = !range || (attribute && truth.is_value_free(*attribute));
  const bool is_unorm = !attribute && triangles_->drawn.scene.scene().unorm_bits() != 0;
  steps.take(Stage::left_open,
             is_free ? last : std::clamp(last, to_field(range->lo), to_field(range->hi)));
  steps.take(is_unorm ? Stage::store : Stage::excess, last);
  return ExactSplit{attribute, to_rational(start->value), triangles_->unit(attribute, start->value),
                    steps.finish(), false};
}

}  // namespace rastercheck::oracle
