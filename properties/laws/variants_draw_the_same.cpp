// Threads, tiles and SIMD change no bit: the variants that a backend names as drawing the same bits
// (Backend::same_as) draw the same fragments and pictures as the backend itself.
//
// Why. The promise is the backend's own. `cpu` makes it for fragments and framebuffers, for any
// number of threads and all kinds of vectors, because its kernels round each product and each sum
// and fuse none, and because each sample is drawn by one thread, in the order of the triangles. If
// a backend promises nothing of the kind, the law does not apply: two drawings within a contract's
// bound may differ.
//
// Samples: all. At most two of the variants draw a case. They are spread over the list, from a
// place chosen at random (choices.h). If the backend and the variant draw pictures, their pictures
// are compared as well, with a pipeline chosen at random. Derivatives are compared if both drawings
// have them.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/pipelines.h"
#include "properties/laws/internal/same_drawing.h"
#include "properties/laws/internal/same_picture.h"

namespace rastercheck::properties::variants_draw_the_same_law {
namespace {

constexpr std::size_t kMostVariants = 2;

/// Chooses at most kMostVariants of the variants.
std::vector<std::string> some_of(const std::vector<std::string>& all, const cases::Case& c) {
  const std::size_t count = std::min(all.size(), kMostVariants);
  const auto first = static_cast<std::size_t>(choices_of(c) % all.size());
  std::vector<std::string> some;
  some.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    some.push_back(all[(first + i * all.size() / count) % all.size()]);
  }
  return some;
}

/// Labels the ways of dividing work that a case exercises.
void add_labels(const cases::Case& c, const cases::Fragments& drawn, Check& check) {
  // Larger than the tiles and blocks of most rasterizers.
  constexpr std::uint16_t kSide = 64;
  const auto is_beyond = [](std::uint16_t at) { return at >= kSide; };
  if (std::any_of(drawn.x.begin(), drawn.x.end(), is_beyond) ||
      std::any_of(drawn.y.begin(), drawn.y.end(), is_beyond)) {
    add_label(check, "beyond 64 pixels");
  }
  if (c.attributes.size() > 2) add_label(check, "three attributes and more");
}

bool is_promised(backends::Backend& backend) { return !backend.about().same_as.empty(); }

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  const std::vector<std::string> all = backend.about().same_as;
  if (all.empty()) return not_applicable("the backend has no variants");
  const Result<backends::Drawn> own = draw_promised(clip, backend);
  if (!own) return tl::unexpected(own.error());
  const cases::Pipeline pipeline = pipeline_of(clip);
  std::optional<cases::Picture> picture;
  if (backend.picture_drawer() != nullptr) {
    const Result<cases::Picture> drawn = draw_picture(clip, backend, pipeline);
    if (!drawn) return tl::unexpected(drawn.error());
    picture = *drawn;
  }
  Check check;
  for (const std::string& specification : some_of(all, clip)) {
    const auto variant = backends::make_backend(specification);
    if (!variant) return tl::unexpected(variant.error());
    (*variant)->hold_to(backend.terms());
    const Result<backends::Drawn> drawn = draw_promised(clip, **variant);
    if (!drawn) return tl::unexpected(drawn.error());
    const std::string note = specification + " draws the expected value";
    merge(check, compare_drawings(clip, drawn->fragments, own->fragments, note));
    if (!picture || (*variant)->picture_drawer() == nullptr) continue;
    const Result<cases::Picture> other = draw_picture(clip, **variant, pipeline);
    if (!other) return tl::unexpected(other.error());
    merge(check, compare_pictures(clip, *other, *picture, note + "; " + text_of(pipeline)));
  }
  add_labels(clip, own->fragments, check);
  return check;
}

/// Makes a side longer than 64 pixels, all of it within the viewport.
void lengthen(Draw& draw, cases::Case& c) {
  const int length = draw.between(65, 140);
  const int breadth = draw.between(4, 12);
  const bool is_high = draw.one_in(2);
  cases::FramebufferSize& size = c.framebuffer;
  size.width = is_high ? breadth : length;
  size.height = is_high ? length : breadth;
  size.samples = std::min(size.samples, 4);
  c.viewport.x = 0;
  c.viewport.y = 0;
  c.viewport.width = static_cast<float>(size.width);
  c.viewport.height = static_cast<float>(size.height);
  c.scissor.reset();
}

Generated generate(Draw& draw) {
  Generated made = draw.one_in(2) ? generate_any(draw) : overlapping_case(draw);
  if (draw.one_in(3)) lengthen(draw, made.source);
  return made;
}

const LawRegistration kRegistration(
    {.id = "threads-tiles-and-simd-change-no-bit",
     .sentence = "threads, tiles and SIMD change no bit",
     .reason = "A backend that names others as drawing the same bits is held to its word.",
     .exceptions = "backends that name none, and derivatives where one of two has none",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "needs another backend that promises identical bits",
     .takes_lines_and_points = true,
     .covers = {cover(40, "drawn"), cover(10, "beyond 64 pixels"), cover(15, "several samples"),
                cover(20, "three attributes and more"), cover(10, "clipped")}});

}  // namespace
}  // namespace rastercheck::properties::variants_draw_the_same_law
