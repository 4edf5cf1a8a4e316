// Values at vertices come back: a sample exactly at a vertex of its triangle has the vertex's
// attribute values, to the bit.
//
// This follows from r = Σ r_i E_i / Σ E_i, where two of the E_i are 0. It does not follow from a
// bound in scale ULP: if another vertex has a value a million times as large, r_i may be off by
// thousands of its own ulps within the bound. A program that reads an index or a flag back from a
// corner needs it unchanged. The law applies if the contract promises this.
//
// Vertices: w > 0, and the window position is exactly that of the sample (is_exactly_at). If values
// come from snapped positions, the sample must be a grid point, and positions must be exact before
// they are rounded: then the vertex stays where it is. Attributes: smooth and noperspective ones
// that are evaluated at the sample. Zeros of either sign are the same: r_i may be −0, and the other
// terms add +0 to it. Samples: required ones, so that snapping and clipping of the outline do not
// matter.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cases/sample_pattern.h"
#include "oracle/ulp.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::vertex_values_come_back_law {
namespace {

using oracle::Rational;
using records::AttributeKind;
using records::FragmentClass;

// --- The law -------------------------------------------------------------------------------------

/// Indices of the attributes that the law checks.
std::vector<std::uint32_t> attributes_at_samples(const cases::Case& c) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t a = 0; a < c.attributes.size(); ++a) {
    const cases::Attribute& attribute = c.attributes[a];
    if (attribute.interpolation == cases::Interpolation::flat) continue;
    const bool is_at_sample =
        c.framebuffer.samples == 1 || attribute.location == cases::Location::sample;
    if (is_at_sample) indices.push_back(a);
  }
  return indices;
}

/// True if a vertex exactly at the sample stays there in the positions from which values come.
bool stays_in_place(const cases::Contract& contract, const cases::SamplePosition& at) {
  if (!contract.coverage || contract.basis == cases::Basis::ideal) return true;
  // The sample is a multiple of 2^-b if its sixteenths times 2^b are divisible by 16.
  if (contract.coverage->odd_steps > 1) return false;
  const int bits = std::min(contract.coverage->subpixel_bits, 4);
  const bool is_grid_point = ((at.x << bits) | (at.y << bits)) % 16 == 0;
  return is_grid_point && contract.is_on_grid && contract.coverage->position_error == 0;
}

class VertexCheck {
 public:
  VertexCheck(const cases::Case& c, const cases::Contract& contract, const cases::Fragments& drawn)
      : case_(&c),
        contract_(contract),
        drawn_(&drawn),
        pattern_(cases::standard_pattern(c.framebuffer.samples)),
        attributes_(attributes_at_samples(c)),
        verdicts_(c, contract),
        tally_(c) {}

  Check run() {
    for (std::size_t i = 0; i < drawn_->size(); ++i) check_fragment(i);
    if (tally_.counts().required == 0) return not_applicable("no sample lies at a vertex");
    if (case_->coverage) tally_.label("snapped");
    return tally_.finish();
  }

 private:
  /// The vertex, 0 to 2, that lies exactly at a sample; empty if none does.
  std::optional<std::size_t> vertex_at(const cases::SamplePlace& place) const {
    const cases::SamplePosition offset = pattern_[place.sample];
    const WindowPoint p{place.x + offset.x / 16.0, place.y + offset.y / 16.0};
    const cases::Triangle& triangle = case_->triangles[place.triangle];
    for (std::size_t i = 0; i < 3; ++i) {
      const cases::ClipVertex& vertex = case_->positions[triangle[i]];
      if (vertex.w > 0 && is_exactly_at(*case_, vertex, p)) return i;
    }
    return std::nullopt;
  }

  void check_fragment(std::size_t i) {
    const cases::SamplePlace place = drawn_->place_of(i);
    if (!is_of_case(*case_, place) || !stays_in_place(contract_, pattern_[place.sample])) return;
    const auto vertex = vertex_at(place);
    if (!vertex) return;
    const records::SampleVerdict decision = verdicts_.judge(place.triangle, place);
    if (decision.verdict != records::Verdict::required) return;
    bool is_judged = false;
    for (const std::uint32_t a : attributes_) {
      if (verdicts_.truth(place.triangle).is_value_free(a)) continue;
      is_judged = true;
      check_attribute(place, *vertex, a, drawn_->attributes_of(i)[a]);
    }
    if (!is_judged) return;
    tally_.pass_required(place.triangle);
    if (decision.reason != records::Reason::inside) {
      tally_.label(records::to_string(decision.reason));
    }
  }

  void check_attribute(const cases::SamplePlace& place, std::size_t vertex, std::uint32_t attribute,
                       float actual) {
    const cases::Triangle& triangle = case_->triangles[place.triangle];
    const float expected = case_->attributes_of(triangle[vertex])[attribute];
    add_value_labels(triangle, attribute, expected);
    const AttributeKind kind = records::kind_of(case_->attributes[attribute].interpolation);
    if (actual == expected) return tally_.pass(kind);
    const Rational exact{double{expected}};
    records::Violation violation =
        violation_at(place, class_of_wrong(actual, FragmentClass::beyond_bound), exact.to_string(),
                     fmt::format("vertex {} lies exactly at this sample and has {}",
                                 triangle[vertex], value_text(expected)),
                     {kind, attribute, actual});
    if (std::isfinite(actual)) {
      violation.error = oracle::scale_ulp_error(
          actual, exact, verdicts_.truth(place.triangle).attribute_magnitude(attribute));
    }
    tally_.report(violation);
  }

  void add_value_labels(const cases::Triangle& triangle, std::uint32_t attribute, float expected) {
    constexpr float kFarBelow = 0x1p-16F;
    float greatest = 0;
    for (const std::uint32_t vertex : triangle) {
      greatest = std::max(greatest, std::abs(case_->attributes_of(vertex)[attribute]));
    }
    if (expected == 0) {
      tally_.label("vertex zero");
    } else if (std::abs(expected) < kFarBelow * greatest) {
      tally_.label("vertex value far below the others");
    } else {
      tally_.label("vertex value");
    }
  }

  const cases::Case* case_;
  cases::Contract contract_;
  const cases::Fragments* drawn_;
  std::span<const cases::SamplePosition> pattern_;
  std::vector<std::uint32_t> attributes_;
  Verdicts verdicts_;
  Tally tally_;
};

Check find(const cases::Case& c, const backends::Drawn& drawn) {
  if (!drawn.contract.keeps_vertex_values)
    return not_applicable("the backend does not promise to keep the vertices' values");
  return VertexCheck(c, drawn.contract, drawn.fragments).run();
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, &find);
}

bool is_promised(backends::Backend& backend) {
  // A sample of the backend's own lies at no vertex of the cases that this law makes.
  const cases::Contract contract = backend.contract({});
  return contract.keeps_vertex_values && !contract.sample_position;
}

// --- Its cases -----------------------------------------------------------------------------------

/// A case in which vertices can lie exactly on samples.
struct VertexCanvas {
  cases::Case source;
  /// If a weight has at most this many bits, the clip position of a sample is exact in float32.
  int weight_bits = 12;
};

/// Makes a case with a viewport on the grid, or with one moved off the grid by multiples of 2^-12
/// pixel, so that arithmetic in double rounds the coordinates of samples.
VertexCanvas random_canvas(Draw& draw) {
  StateRequest request;
  request.is_on_grid = true;
  request.most_side = 32;
  VertexCanvas canvas{random_state(draw, request)};
  cases::Case& c = canvas.source;
  if (draw.one_in(2)) {
    const int x = draw.between(-4095, 4095);
    const int y = draw.between(-4095, 4095);
    c.viewport.x += static_cast<float>(x) / 4096;
    c.viewport.y += static_cast<float>(y) / 4096;
    canvas.weight_bits = 6;
  }
  if (draw.one_in(2)) set_snapped_coverage(draw, c);
  // Culling and scissors hide most of what a case tests.
  if (!draw.one_in(4)) c.cull = cases::Cull::none;
  if (!draw.one_in(4)) c.scissor.reset();
  return canvas;
}

/// n · 2^-k with n of up to `bits` bits.
float short_weight(Draw& draw, int bits) {
  const int used = draw.between(1, bits);
  const int n = draw.between(1 << (used - 1), (1 << used) - 1);
  const int places = draw.between(used - 3, used + 3);
  const auto unit = static_cast<float>(std::uint64_t{1} << std::max(places, 0));
  return static_cast<float>(n) / unit;
}

cases::ClipVertex on_sample(Draw& draw, const VertexCanvas& canvas, const WindowPoint& p) {
  const cases::Case& c = canvas.source;
  const float depth = draw.uniform(near_depth(c) * 0.75F, 0.75F);
  const float w = short_weight(draw, canvas.weight_bits);
  return at_window(c, p, depth, w);
}

/// A vertex at `p`, with any w, sometimes behind the eye.
cases::ClipVertex anywhere(Draw& draw, const VertexCanvas& canvas, const WindowPoint& p) {
  const cases::Case& c = canvas.source;
  const float depth = draw.uniform(near_depth(c) * 0.75F, 0.75F);
  const bool is_behind = draw.one_in(24);
  const float w = is_behind ? draw.uniform(-2, -0.125F) : draw.uniform(0.125F, 4);
  return at_window(c, p, depth, w);
}

/// Adds four triangles around a sample, with a rim point in each quadrant. Exactly one of the
/// triangles owns the sample.
void add_fan(Draw& draw, VertexCanvas& canvas) {
  constexpr std::array<WindowPoint, 4> kQuadrants{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  const WindowPoint middle = visible_sample(draw, canvas.source);
  const float reach = draw.pick(std::array{0.0625F, 2.0F, 8.0F, 40.0F});
  const bool is_on_samples = draw.one_in(3);
  const cases::ClipVertex of_middle = on_sample(draw, canvas, middle);
  const std::uint32_t hub = add_vertex(canvas.source, of_middle);
  for (const WindowPoint& quadrant : kQuadrants) {
    if (is_on_samples) {
      const int along = draw.between(1, 8);
      const int across = draw.between(1, 8);
      const WindowPoint p{middle.u + quadrant.u * along, middle.v + quadrant.v * across};
      const cases::ClipVertex rim = on_sample(draw, canvas, p);
      add_vertex(canvas.source, rim);
    } else {
      const double along = double{draw.uniform(0, reach)};
      const double across = double{draw.uniform(0, reach)};
      const WindowPoint p{middle.u + quadrant.u * along, middle.v + quadrant.v * across};
      const cases::ClipVertex rim = anywhere(draw, canvas, p);
      add_vertex(canvas.source, rim);
    }
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    canvas.source.triangles.push_back({hub, hub + 1 + i, hub + 1 + (i + 1) % 4});
  }
}

/// Adds a thin triangle with its tip at a sample. The triangle extends to the right, so that every
/// fill rule includes the tip, or to the left.
void add_sliver(Draw& draw, VertexCanvas& canvas) {
  const WindowPoint tip = visible_sample(draw, canvas.source);
  const double direction = draw.one_in(4) ? -1 : 1;
  const auto thickness = [&draw] {
    return 1.0 / static_cast<double>(std::uint64_t{1} << draw.between(0, 16));
  };
  const double first_length = double{draw.uniform(1, 40)};
  const double first_off = thickness();
  const double second_length = double{draw.uniform(1, 40)};
  const double second_off = thickness();
  const cases::ClipVertex first = on_sample(draw, canvas, tip);
  const cases::ClipVertex second =
      anywhere(draw, canvas, {tip.u + direction * first_length, tip.v - first_off});
  const cases::ClipVertex third =
      anywhere(draw, canvas, {tip.u + direction * second_length, tip.v + second_off});
  add_triangle(canvas.source, third, first, second);
}

/// Adds a triangle with at least one vertex on a sample.
void add_free_triangle(Draw& draw, VertexCanvas& canvas) {
  std::array<cases::ClipVertex, 3> corners;
  const std::size_t certain = static_cast<std::size_t>(draw.between(0, 2));
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == certain || draw.one_in(2)) {
      const WindowPoint p = visible_sample(draw, canvas.source);
      corners[i] = on_sample(draw, canvas, p);
    } else {
      const WindowPoint p = point_about(draw, canvas.source);
      corners[i] = anywhere(draw, canvas, p);
    }
  }
  add_triangle(canvas.source, corners[0], corners[1], corners[2]);
}

/// How the vertices' values of one attribute relate to each other.
enum class Spread { ordinary, mixed, far_below, zeros, extreme };

float random_value(Draw& draw, Spread spread) {
  switch (spread) {
    case Spread::ordinary:
      return draw.uniform(-1, 1);
    case Spread::mixed:
      return draw.spread(-24, 24);
    case Spread::far_below:
      return draw.one_in(3) ? draw.uniform(1, 2) : draw.spread(-32, -18);
    case Spread::zeros:
      return draw.one_in(2) ? draw.pick(std::array{0.0F, -0.0F}) : draw.uniform(-1, 1);
    case Spread::extreme:
      break;
  }
  return draw.one_in(2) ? draw.spread(100, 127) : draw.spread(-149, -110);
}

void add_values(Draw& draw, cases::Case& c) {
  cases::Attribute own;
  own.name = "own";
  if (draw.one_in(3)) own.interpolation = cases::Interpolation::noperspective;
  c.attributes.push_back(own);
  const std::size_t count = c.attributes.size();
  c.attribute_values.assign(c.positions.size() * count, 0.0F);
  for (std::size_t a = 0; a < count; ++a) {
    const Spread spread = draw.pick(std::array{Spread::ordinary, Spread::mixed, Spread::far_below,
                                               Spread::far_below, Spread::zeros, Spread::extreme});
    for (std::size_t v = 0; v < c.positions.size(); ++v) {
      c.attribute_values[v * count + a] = random_value(draw, spread);
    }
  }
}

Generated generate(Draw& draw) {
  struct Shape {
    const char* name;
    void (*add)(Draw&, VertexCanvas&);
    int most;
  };
  constexpr std::array<Shape, 3> kShapes{
      {{"fans", &add_fan, 2}, {"slivers", &add_sliver, 5}, {"on samples", &add_free_triangle, 5}}};
  VertexCanvas canvas = random_canvas(draw);
  const Shape& shape = draw.pick(kShapes);
  const int count = draw.between(1 + shape.most / 3, shape.most);
  for (int i = 0; i < count; ++i) shape.add(draw, canvas);
  add_values(draw, canvas.source);
  add_clip_distances(draw, canvas.source);
  const std::string coverage = !canvas.source.coverage                      ? "exact"
                               : canvas.source.basis == cases::Basis::ideal ? "snapped"
                                                                            : "snapped basis";
  return {std::move(canvas.source), fmt::format("{}, {}", shape.name, coverage)};
}

const LawRegistration kRegistration(
    {.id = "values-at-vertices-come-back",
     .sentence = "values at vertices come back",
     .reason = "At a vertex two of the E_i are 0, and r_i E_i / E_i is r_i.",
     .exceptions = "vertices that are not exactly at a sample, attributes at centres and "
                   "centroids; backends that do not promise it",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not promise to keep the vertices' values",
     .needs_samples = true,
     .covers = {cover(17, "several samples"), cover(30, "snapped"), cover(44, "vertex value"),
                cover(30, "vertex value far below the others"), cover(11, "vertex zero")}});

}  // namespace
}  // namespace rastercheck::properties::vertex_values_come_back_law
