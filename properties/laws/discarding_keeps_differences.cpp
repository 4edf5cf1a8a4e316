// Discarding keeps differences: the differences across a quad (cases::Shading) of a fragment that
// is drawn are the same, to the bit, whether or not other fragments of its quad are discarded.
//
// Why. A shader takes its derivatives before it discards, and a fragment that will be discarded has
// the same values as one that will not: in GLSL, discarding ends only the fragment's own
// invocation, after the statements before it. A rasterizer or a driver's compiler that discards
// early leaves the neighbour's value undefined, and textures with holes get wrong levels along the
// holes' edges.
//
// One triangle of the case, chosen at random (choices.h), is drawn twice, by the pipeline of
// differences along x or y: with a limit (Pipeline::discard_below) that discards fragments with the
// lesser values of the last attribute, and without one. With the limit, every sample shows either
// what it shows without, or the cleared picture. A backend that promises that irrelevant changes
// leave all bits unchanged draws the second picture without discarding. For others the same shader
// is run with a limit below all values: APIs promise that a shader gives the same results when run
// again with the same input.
//
// Samples: all. A sample counts as kept if it shows another colour than the cleared one; of
// differences that are all 0 this cannot be told. Only backends that draw pictures, and promise
// differences across quads, are judged; drivers not in cases with centroids of several samples,
// where their contracts leave open which fragments a picture has (lavapipe's differences there do
// change).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/same_picture.h"
#include "properties/laws/internal/tally.h"
#include "properties/random_state.h"

namespace rastercheck::properties::discarding_keeps_differences_law {
namespace {

/// The depth that pictures are cleared to.
constexpr float kCleared = 1;

struct Drawing {
  cases::ClipCase source;  ///< with the chosen triangle only
  cases::Pipeline pipeline;
  std::uint32_t triangle = 0;  ///< its index in the given case
};

/// Chooses the triangle and the axis. The limit is half-way between the triangle's values.
Drawing drawing_of(const cases::ClipCase& c) {
  Choices choices(choices_of(c));
  Drawing drawing{c, {}, static_cast<std::uint32_t>(choices.below(c.triangles.size()))};
  const cases::Triangle triangle = c.triangles[drawing.triangle];
  drawing.source.triangles = {triangle};
  drawing.source.depth_test = cases::DepthTest::none;
  drawing.pipeline.depth_function = cases::DepthFunction::always;
  drawing.pipeline.clear_depth = kCleared;
  drawing.pipeline.shading = choices.pick(
      std::array{cases::Shading::differences_along_x, cases::Shading::differences_along_y});
  const std::size_t last = c.attributes.size() - 1;
  const auto value = [&](std::size_t i) { return c.attributes_of(triangle[i])[last]; };
  const auto [least, greatest] = std::minmax({value(0), value(1), value(2)});
  drawing.pipeline.discard_below = least / 2 + greatest / 2;  // halves do not overflow
  return drawing;
}

class DiscardCheck {
 public:
  DiscardCheck(const Drawing& drawing, const cases::Picture& whole, const cases::Picture& part)
      : drawing_(&drawing), whole_(&whole), part_(&part), tally_(drawing.source) {}

  Check run() {
    tally_.label(is_along_x() ? "along x" : "along y");
    for (std::size_t at = 0; at < whole_->depth.size(); ++at) check_sample(at);
    return tally_.finish();
  }

 private:
  bool is_along_x() const {
    return drawing_->pipeline.shading == cases::Shading::differences_along_x;
  }

  /// True if the sample shows the colour and the depth that pictures are cleared to.
  static bool is_cleared(const cases::Picture& picture, std::size_t at) {
    if (picture.depth[at] != kCleared) return false;
    for (std::size_t k = 0; k < picture.channels; ++k) {
      if (picture.color[at * picture.channels + k] != 0) return false;
    }
    return true;
  }

  void check_sample(std::size_t at) {
    const bool is_drawn = !is_cleared(*whole_, at);
    if (is_cleared(*part_, at)) {
      if (is_drawn) tally_.label("discarded");
      return;
    }
    tally_.pass_required(0);
    if (is_drawn) tally_.label(has_lost_neighbor(at) ? "beside a discarded one" : "kept");
    if (!is_same(part_->depth[at], whole_->depth[at])) {
      report(at, std::nullopt, whole_->depth[at]);
    }
    for (std::uint32_t channel = 0; channel < whole_->channels; ++channel) {
      const std::size_t index = at * whole_->channels + channel;
      if (is_same(part_->color[index], whole_->color[index])) {
        tally_.pass(kind_of_channel(drawing_->source, channel));
      } else {
        report(at, channel, whole_->color[index]);
      }
    }
  }

  /// True if the neighbour that the difference is taken to was discarded.
  bool has_lost_neighbor(std::size_t at) const {
    cases::SamplePlace place = place_at(*whole_, at);
    (is_along_x() ? place.x : place.y) ^= 1U;
    const bool is_inside =
        std::cmp_less(place.x, whole_->size.width) && std::cmp_less(place.y, whole_->size.height);
    if (!is_inside) return false;
    const std::size_t neighbor = index_at(*whole_, place);
    return !is_cleared(*whole_, neighbor) && is_cleared(*part_, neighbor);
  }

  void report(std::size_t at, std::optional<std::uint32_t> channel, float expected) {
    records::Violation violation = picture_violation(
        drawing_->source, *part_, at, channel, expected,
        fmt::format("differences along window {}, values of the last attribute below {} discarded; "
                    "expected is what is drawn where none are",
                    is_along_x() ? "x" : "y", *drawing_->pipeline.discard_below));
    violation.place.triangle = drawing_->triangle;
    tally_.report(violation);
  }

  const Drawing* drawing_;
  const cases::Picture* whole_;
  const cases::Picture* part_;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_differences(backend) || c.attributes.empty() || c.triangles.empty())
    return not_applicable(
        "the backend promises no differences across quads, or the case has no attributes");
  const Drawing drawing = drawing_of(c);
  const cases::Contract contract = backend.contract(drawing.source);
  if (!keeps_fragments_in_pictures(contract)) return not_applicable(kOtherFragments);
  const Result<cases::Picture> part = draw_picture(drawing.source, backend, drawing.pipeline);
  if (!part) return tl::unexpected(part.error());
  cases::Pipeline whole_pipeline = drawing.pipeline;
  whole_pipeline.discard_below.reset();
  if (!contract.is_invariant) {
    whole_pipeline.discard_below = std::numeric_limits<float>::lowest();
  }
  const Result<cases::Picture> whole = draw_picture(drawing.source, backend, whole_pipeline);
  if (!whole) return tl::unexpected(whole.error());
  return DiscardCheck(drawing, *whole, *part).run();
}

/// Makes any case whose last attribute varies.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  ensure_attribute(draw, c);
  const std::size_t count = c.attributes.size();
  c.attributes.back().interpolation =
      draw.one_in(3) ? cases::Interpolation::noperspective : cases::Interpolation::smooth;
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    c.attribute_values[v * count + count - 1] = draw.uniform(-1, 1);
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "discarding-keeps-differences",
     .sentence = "discarding keeps differences",
     .reason = "A shader takes its derivatives before it discards, when the discarded fragments of "
               "a quad have their values still.",
     .exceptions = "cases without attributes; backends that promise no differences across quads; "
                   "drivers' centroids of several samples",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_differences,
     .unpromised =
         "the backend draws no pictures or promises no bound for differences across quads",
     .covers = {cover(24, "along x"), cover(25, "along y"), cover(8, "beside a discarded one"),
                cover(3, "clipped"), cover(20, "discarded"), cover(18, "kept"),
                cover(6, "several samples")}});

}  // namespace
}  // namespace rastercheck::properties::discarding_keeps_differences_law
