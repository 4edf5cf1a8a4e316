// Nothing is written outside viewport and scissor: no fragment has its sample outside the viewport
// or its pixel outside the scissor, and a picture keeps its clear values there, to the bit.
//
// Why. Clipping in x and y is the viewport itself (RULES §2). For W of either sign, the points
// inside are those with
//
//   min(x0, x0 + W) <= u < max(x0, x0 + W)
//
// and likewise for v. On the far border, which OpenGL and Vulkan leave open, nothing is checked.
// The inside depends neither on the contract's coverage nor on a grid: its borders are not snapped.
// If a contract allows the viewport's position an error, the sides may lie that much farther out. u
// is a multiple of 1/16 below 2^15 and exact in double. The sum x0 + W of two floats need not be
// exact in double, but is compared without rounding. The scissor contains the pixels with x <= i <
// x + width, in integers; it may reach beyond the framebuffer or have no area.
//
// Samples: all samples outside, whether or not anything is near them; other laws check the inside.
// Backends that draw pictures draw a picture without a depth test, so that anything that reaches a
// sample is written. The clear values are random (choices.h).

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/names.h"
#include "properties/choices.h"
#include "properties/exact_sum.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/same_picture.h"
#include "properties/laws/internal/tally.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::nothing_outside_viewport_and_scissor_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;

enum class Where { inside, far_border, outside };

/// Tells where `at` lies relative to the interval between `from` and `from + size`, widened by
/// `error` on both sides.
Where where(float from, float size, double error, double at) {
  const double begin{from};
  const double extent{size};
  const double outwards = size >= 0 ? error : -error;
  const int past_begin = sign_of_sum(std::array{at, outwards, -begin});
  const int before_end = sign_of_sum(std::array{begin, extent, outwards, -at});
  if (size >= 0) {
    if (past_begin < 0 || before_end < 0) return Where::outside;
    return before_end == 0 ? Where::far_border : Where::inside;
  }
  if (before_end > 0 || past_begin > 0) return Where::outside;
  return past_begin == 0 ? Where::far_border : Where::inside;
}

/// Tells which samples of a framebuffer may be drawn.
class Window {
 public:
  Window(const cases::Case& c, const cases::Contract& contract)
      : scissor_(c.scissor), far_is_outside_(c.rules == cases::Rules::d3d) {
    // How far the viewport's sides may be off, in pixels.
    const double error = contract.has_open_viewport() ? contract.viewport_error : 0;
    const std::vector<WindowPoint> pattern = sample_points(c, contract);
    samples_ = pattern.size();
    for (int x = 0; x < c.framebuffer.width; ++x) {
      for (const WindowPoint& position : pattern) {
        columns_.push_back(where(c.viewport.x, c.viewport.width, error, x + position.u));
      }
    }
    for (int y = 0; y < c.framebuffer.height; ++y) {
      for (const WindowPoint& position : pattern) {
        rows_.push_back(where(c.viewport.y, c.viewport.height, error, y + position.v));
      }
    }
  }

  /// Returns the area that the sample lies outside of, by name; empty if the sample may be drawn.
  std::string_view outside_of(std::size_t x, std::size_t y, std::size_t sample) const {
    if (scissor_ && !(is_within(x, scissor_->x, scissor_->width) &&
                      is_within(y, scissor_->y, scissor_->height))) {
      return "scissor";
    }
    const Where column = columns_[x * samples_ + sample];
    const Where row = rows_[y * samples_ + sample];
    if (is_outside(column) || is_outside(row)) return "viewport";
    return "";
  }

 private:
  static bool is_within(std::size_t at, int begin, int size) {
    const auto pixel = static_cast<std::int64_t>(at);
    return begin <= pixel && pixel < std::int64_t{begin} + size;
  }
  bool is_outside(Where at) const {
    return at == Where::outside || (at == Where::far_border && far_is_outside_);
  }

  std::optional<cases::Scissor> scissor_;
  bool far_is_outside_;
  std::size_t samples_ = 1;
  std::vector<Where> columns_;  ///< [x][sample]
  std::vector<Where> rows_;     ///< [y][sample]
};

class OutsideCheck {
 public:
  OutsideCheck(const cases::Case& c, const cases::Contract& contract)
      : case_(&c), window_(c, contract), tally_(c) {}

  void see(const cases::Fragments& drawn) {
    bool is_any_inside = false;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const cases::SamplePlace place = drawn.place_of(i);
      // If the case lacks the place, the fragment is outside the target itself.
      const std::string_view what =
          is_of_case(*case_, place) ? window_.outside_of(place.x, place.y, place.sample) : "target";
      if (what.empty()) {
        is_any_inside = true;
        tally_.see(place.triangle);
        tally_.pass(AttributeKind::coverage);
      } else {
        tally_.report(violation_at(place, FragmentClass::extra,
                                   "forbidden: outside the " + std::string(what), ""));
      }
    }
    tally_.counts().required = drawn.size();
    add_labels(is_any_inside);
  }

  void see(const cases::Picture& picture, float clear_depth) {
    for (std::size_t at = 0; at < picture.depth.size(); ++at) {
      const cases::SamplePlace place = place_at(picture, at);
      const std::string_view what = window_.outside_of(place.x, place.y, place.sample);
      if (what.empty()) continue;
      const std::string note =
          "in a picture, outside the " + std::string(what) + ", where nothing may be written";
      keep(picture, at, std::nullopt, clear_depth, picture.depth[at], note);
      for (std::uint32_t channel = 0; channel < picture.channels; ++channel) {
        keep(picture, at, channel, 0, picture.color[at * picture.channels + channel], note);
      }
    }
  }

  Check finish() { return tally_.finish(); }

 private:
  void keep(const cases::Picture& picture, std::size_t at, std::optional<std::uint32_t> channel,
            float expected, float actual, const std::string& note) {
    if (is_same(expected, actual)) return;
    records::Violation violation = picture_violation(*case_, picture, at, channel, expected, note);
    violation.fragment_class = FragmentClass::extra;
    tally_.report(violation);
  }

  void add_labels(bool is_drawn) {
    const cases::Viewport& viewport = case_->viewport;
    if (is_drawn) tally_.label("drawn");
    if (is_drawn && case_->scissor) tally_.label("scissor");
    if (is_drawn && (viewport.width < 0 || viewport.height < 0)) tally_.label("negative size");
    if (is_drawn && has_outside("viewport")) tally_.label("outside the viewport");
    if (case_->scissor && (case_->scissor->width == 0 || case_->scissor->height == 0)) {
      tally_.label("scissor without area");
    }
  }

  bool has_outside(std::string_view what) const {
    const auto width = static_cast<std::size_t>(case_->framebuffer.width);
    const auto height = static_cast<std::size_t>(case_->framebuffer.height);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        if (window_.outside_of(x, y, 0) == what) return true;
      }
    }
    return false;
  }

  const cases::Case* case_;
  Window window_;
  Tally tally_;
};

cases::Pipeline pipeline_without_test(const cases::Case& c) {
  Choices choices(choices_of(c));
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.clear_depth = choices.pick(std::array{0.0F, 0.5F, 0.625F, 1.0F});
  if (c.attributes.size() >= 3 && choices.below(2) != 0) {
    pipeline.shading = cases::Shading::vertex_colors;
    if (choices.below(2) != 0) pipeline.format = cases::ColorFormat::rgba8;
  }
  return pipeline;
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  OutsideCheck all(clip, drawn->contract);
  all.see(drawn->fragments);
  if (backend.picture_drawer() != nullptr) {
    const cases::Pipeline pipeline = pipeline_without_test(clip);
    const Result<cases::Picture> picture = draw_picture(clip, backend, pipeline);
    if (!picture) return tl::unexpected(picture.error());
    all.see(*picture, pipeline.clear_depth);
  }
  return all.finish();
}

// --- the law's own cases: small viewports and scissors, large triangles --------------------------

/// A part of a side of the framebuffer, in pixels.
struct Part {
  float from = 0;
  float extent = 0;
};

/// Returns a part of at least a quarter of the side, in multiples of 1/parts. It lies within the
/// framebuffer or at most a quarter beyond it.
Part random_part(Draw& draw, int size, int parts) {
  const int side = size * parts;
  const int from = draw.between(-side / 4, side / 2);
  const int extent = draw.between(side / 4, side * 5 / 4 - from);
  return {static_cast<float>(from) / static_cast<float>(parts),
          static_cast<float>(extent) / static_cast<float>(parts)};
}

/// Reverses a side, which then begins at the other end and has the opposite size.
void turn_round(float& from, float& size) {
  from += size;
  size = -size;
}

void set_viewport(Draw& draw, cases::Case& c) {
  // Whole pixels, sixteenths (borders on samples), or thousandths.
  const int parts = draw.pick(std::array{1, 16, 16, 1000});
  const Part across = random_part(draw, c.framebuffer.width, parts);
  const Part down = random_part(draw, c.framebuffer.height, parts);
  c.viewport.x = across.from;
  c.viewport.y = down.from;
  c.viewport.width = across.extent;
  c.viewport.height = down.extent;
  if (draw.one_in(4)) turn_round(c.viewport.x, c.viewport.width);
  if (draw.one_in(4)) turn_round(c.viewport.y, c.viewport.height);
}

void set_scissor(Draw& draw, cases::Case& c) {
  c.scissor.reset();
  if (draw.one_in(2)) return;
  const Part across = random_part(draw, c.framebuffer.width, 1);
  const Part down = random_part(draw, c.framebuffer.height, 1);
  cases::Scissor scissor{static_cast<int>(across.from), static_cast<int>(down.from),
                         static_cast<int>(across.extent), static_cast<int>(down.extent)};
  switch (draw.between(0, 7)) {
    case 0:
      scissor.width = 0;
      break;
    case 1:
      scissor.height = 0;
      break;
    case 2:  // far beyond the framebuffer
      scissor.width = cases::kMaxSize;
      scissor.height = cases::kMaxSize;
      break;
    case 3:
      scissor.x = c.framebuffer.width;
      break;
    default:
      break;
  }
  c.scissor = scissor;
}

/// Returns a vertex anywhere in the framebuffer, or beyond it by up to its size on every side.
cases::ClipVertex random_vertex(Draw& draw, const cases::Case& c) {
  const auto width = static_cast<float>(c.framebuffer.width);
  const auto height = static_cast<float>(c.framebuffer.height);
  WindowPoint p;
  p.u = double{draw.uniform(-width, 2 * width)};
  p.v = double{draw.uniform(-height, 2 * height)};
  const float depth = draw.one_in(8) ? draw.uniform(-2, 2) : random_depth(draw, c);
  const float w = draw.one_in(2) ? 1.0F : draw.uniform(0.25F, 4);
  return at_window(c, p, depth, draw.one_in(10) ? -w : w);
}

Generated generate(Draw& draw) {
  StateRequest request;
  request.most_side = 32;
  Generated made;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  made.stratum = "windows of " + std::string(cases::name_of(c.rules));
  if (!draw.one_in(4)) c.cull = cases::Cull::none;
  set_viewport(draw, c);
  set_scissor(draw, c);
  const int triangles = draw.between(1, 3 + draw.size() / 25);
  for (int i = 0; i < triangles; ++i) {
    const cases::ClipVertex first = random_vertex(draw, c);
    const cases::ClipVertex second = random_vertex(draw, c);
    const cases::ClipVertex third = random_vertex(draw, c);
    add_triangle(c, first, second, third);
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "nothing-is-written-outside-viewport-and-scissor",
     .sentence = "nothing is written outside viewport and scissor",
     .reason = "Clipping in x and y is the viewport itself, and the scissor is a test of pixels.",
     .exceptions = "samples on the viewport's far border under the rules of OpenGL and Vulkan",
     .generate = &generate,
     .check = &check,
     .needs_samples = true,
     .covers = {cover(20, "drawn"), cover(20, "outside the viewport"), cover(8, "scissor"),
                cover(10, "negative size"), cover(5, "scissor without area"),
                cover(5, "several samples"), cover(5, "clipped")}});

}  // namespace
}  // namespace rastercheck::properties::nothing_outside_viewport_and_scissor_law
