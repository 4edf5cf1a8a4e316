// Every way of drawing draws the same bits: if a driver can be asked for a case's fragments in
// several ways (backends::WaysOfDrawing), all give the same fragments.
//
// Why. A fragment's place, depth and attributes depend on its triangle and on the case's state.
// They do not depend on whether the shader writes them to colours or appends them to a buffer, nor
// on the number of triangles in a draw. No API promises this: a driver may take another path if a
// shader has side effects, or if nothing is attached, and another path may round differently. Such
// a difference matters: meshes are drawn by appending, so a defect found in a mesh need not show
// when the case is drawn in layers. Violations say whether the contract permits either drawing.
//
// Samples: all, with values. But OpenGL and Vulkan both let a subnormal number become zero in any
// way of drawing and leave the sign of zeros open, so subnormal numbers and zeros count as equal.
// Ways that cannot draw a case are left out.

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/names.h"
#include "properties/drawing.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/same_drawing.h"

namespace rastercheck::properties::ways_draw_the_same_law {
namespace {

/// More triangles than one batch of a driver holds.
constexpr std::size_t kMany = 500;

/// Returns the fragments with subnormal numbers and −0 replaced by 0.
cases::Fragments flushed(cases::Fragments drawn) {
  const auto flush = [](std::vector<float>& values) {
    for (float& value : values) {
      if (std::fpclassify(value) == FP_SUBNORMAL || value == 0) value = 0;
    }
  };
  flush(drawn.depth);
  flush(drawn.attributes);
  return drawn;
}

/// True if the contract permits a drawing.
bool is_permitted(const cases::ClipCase& c, const cases::Contract& contract,
                  const cases::Fragments& drawn) {
  return judge_drawn(c, contract, drawn, {}, 0).violation_count == 0;
}

/// Reports each fragment that has the same place as the preceding one. Fragments are ordered by
/// place, so repeated ones are neighbours.
void find_repeated(const cases::Fragments& drawn, const std::string& by, Check& check) {
  for (std::size_t i = 1; i < drawn.size(); ++i) {
    if (drawn.place_of(i) != drawn.place_of(i - 1)) continue;
    add_violation(check,
                  violation_at(drawn.place_of(i), records::FragmentClass::extra,
                               "forbidden: drawn more than once", "drawn more than once by " + by));
  }
}

/// Compares the drawings of two ways.
Check compare_ways(const cases::ClipCase& c, const cases::Contract& contract,
                   const cases::Fragments& first, const cases::Fragments& second,
                   std::string note) {
  Check found = compare_drawings(c, first, second, note);
  if (found.violation_count == 0) return found;
  if (is_permitted(c, contract, first) && is_permitted(c, contract, second)) {
    note += "; the contract permits either";
  }
  return compare_drawings(c, first, second, note);
}

bool is_promised(backends::Backend& backend) {
  backends::WaysOfDrawing* const ways = backend.ways_of_drawing();
  return ways != nullptr && ways->ways().size() > 1;
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (!is_promised(backend)) return not_applicable("the backend draws in one way only");
  std::optional<cases::Fragments> first;
  std::string name_of_first;
  std::string lacking;
  Check check;
  bool is_compared = false;
  for (const cases::DrawBy way : backend.ways_of_drawing()->ways()) {
    Result<cases::Fragments> drawn = draw_by(clip, way, backend);
    if (!drawn && drawn.error().failure == Failure::unsupported) {
      lacking = drawn.error().reason;
      continue;
    }
    if (!drawn) return tl::unexpected(drawn.error());
    const std::string name(cases::name_of(way));
    find_repeated(*drawn, name, check);
    if (!first) {
      first = flushed(*std::move(drawn));
      name_of_first = name;
      continue;
    }
    is_compared = true;
    merge(check, compare_ways(clip, backend.contract(clip), *first, flushed(*std::move(drawn)),
                              fmt::format("drawn by {}, compared with {}", name, name_of_first)));
  }
  if (!is_compared) return not_applicable(lacking);
  if (clip.triangles.size() >= kMany) add_label(check, "many triangles");
  return check;
}

/// Makes cases that can be drawn by appending: with one sample per pixel and without a depth test.
/// Some repeat their triangles many times.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  c.framebuffer.samples = 1;
  c.depth_test = cases::DepthTest::none;
  if (!draw.one_in(10)) return made;
  const std::vector<cases::Triangle> all = c.triangles;
  while (!all.empty() && c.triangles.size() < kMany) {
    c.triangles.insert(c.triangles.end(), all.begin(), all.end());
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "every-way-of-drawing-draws-the-same-bits",
     .sentence = "every way of drawing draws the same bits",
     .reason = "Whether a shader writes a fragment to colours or appends it to a buffer has no say "
               "in its place and its values.",
     .exceptions = "backends that draw in one way, depth tests, several samples",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend draws in one way only",
     .takes_lines_and_points = true,
     .covers = {cover(30, "drawn"), cover(4, "many triangles"), cover(10, "clipped")}});

}  // namespace
}  // namespace rastercheck::properties::ways_draw_the_same_law
