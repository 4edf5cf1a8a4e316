// Scissors that divide the window divide the drawing: if the scissor is cut into four rectangles by
// a column and a row, the drawings of the rectangles together equal the whole drawing, bit for bit.
// No fragment is drawn in two of them, and none outside its drawing's rectangle.
//
// Why. A scissor tests pixels (i, j), x <= i < x + width and y <= j < y + height. Nothing else
// about a fragment depends on the scissor: neither its place, nor its values, nor, with a depth
// test, which triangles meet there. OpenGL says so ("Invariance", rule 2 and its corollary:
// fragments do not change with the scissor's parameters, other than whether there is a scissor). So
// the whole is drawn with a scissor as well: the case's own, or one that contains the whole
// framebuffer.
//
// Samples: all, with values and derivatives, even those that the contract leaves open. The column
// and the row are pseudorandom (choices.h), and leave at least one pixel on each side if there are
// two.

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/window_symmetry.h"

namespace rastercheck::properties::scissors_part_the_window_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// Chooses a border between two pixels of a span, if the span has two.
int cut_of(const PixelSpan& span, std::uint64_t number) {
  const int size = span.last - span.first;
  if (size < 2) return span.last;
  return span.first + 1 + static_cast<int>(number % static_cast<std::uint64_t>(size - 1));
}

bool is_within(const cases::Scissor& scissor, const cases::SamplePlace& place) {
  return std::cmp_greater_equal(place.x, scissor.x) &&
         std::cmp_less(place.x, scissor.x + scissor.width) &&
         std::cmp_greater_equal(place.y, scissor.y) &&
         std::cmp_less(place.y, scissor.y + scissor.height);
}

/// How the window is parted.
struct Parting {
  cases::Scissor whole;
  std::array<cases::Scissor, 4> parts;
  bool is_of_case = false;  ///< true if the case has a scissor of its own
};

Parting parting_of(const cases::Case& c) {
  const PixelSpan columns = scissor_columns(c);
  const PixelSpan rows = scissor_rows(c);
  const std::uint64_t number = choices_of(c);
  const int column = cut_of(columns, number >> 32);
  const int row = cut_of(rows, number & 0xffffffffU);
  Parting parting;
  parting.is_of_case = c.scissor.has_value();
  parting.whole = rectangle(columns, rows);
  std::size_t part = 0;
  for (const PixelSpan& down : {PixelSpan{rows.first, row}, PixelSpan{row, rows.last}}) {
    for (const PixelSpan& across :
         {PixelSpan{columns.first, column}, PixelSpan{column, columns.last}}) {
      parting.parts[part++] = rectangle(across, down);
    }
  }
  return parting;
}

std::string text_of(const cases::Scissor& scissor) {
  return "scissor (" + std::to_string(scissor.x) + ", " + std::to_string(scissor.y) + ") + " +
         std::to_string(scissor.width) + "×" + std::to_string(scissor.height);
}

class PartingCheck {
 public:
  PartingCheck(const cases::Case& c, const Parting& parting, const cases::Fragments& whole)
      : case_(&c),
        parting_(&parting),
        whole_(&whole),
        expected_(fragments_by_place(whole)),
        tally_(c) {}

  void see(const cases::Scissor& part, const cases::Fragments& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const cases::SamplePlace place = drawn.place_of(i);
      const auto expected = expected_.find(place);
      if (!is_within(part, place)) {
        tally_.report(violation_at(place, FragmentClass::extra, "forbidden: outside the scissor",
                                   text_of(part)));
      } else if (expected == expected_.end()) {
        tally_.report(violation_at(place, FragmentClass::extra,
                                   "forbidden: it is not drawn in the whole window",
                                   text_of(part)));
      } else if (!seen_.insert(place).second) {
        tally_.report(violation_at(place, FragmentClass::extra, "forbidden: drawn more than once",
                                   text_of(part)));
      } else if (const auto difference =
                     find_difference(*case_, *whole_, expected->second, drawn, i,
                                     "another value than in the whole window; " + text_of(part))) {
        tally_.report(*difference);
      }
    }
    if (!drawn.triangle.empty()) ++parts_drawn_;
  }

  Check finish() {
    for (const auto& [place, index] : expected_) {
      if (!seen_.contains(place)) {
        tally_.report(violation_at(place, FragmentClass::missing,
                                   "required: it is drawn in the whole window",
                                   "not drawn in any part"));
      } else if (is_of_case(*case_, place)) {
        tally_.see(place.triangle);
      }
    }
    tally_.counts().required = expected_.size();
    for (std::size_t i = 0; i < seen_.size(); ++i) tally_.pass(AttributeKind::coverage);
    if (parts_drawn_ > 1) tally_.label("parted");
    if (parting_->is_of_case) tally_.label("scissor");
    return tally_.finish();
  }

 private:
  const cases::Case* case_;
  const Parting* parting_;
  const cases::Fragments* whole_;
  FragmentMap expected_;
  std::set<cases::SamplePlace> seen_;
  int parts_drawn_ = 0;
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  const Parting parting = parting_of(clip);
  clip.scissor = parting.whole;
  const Result<backends::Drawn> whole = draw_promised(clip, backend);
  if (!whole) return tl::unexpected(whole.error());
  PartingCheck all(clip, parting, whole->fragments);
  for (const cases::Scissor& part : parting.parts) {
    clip.scissor = part;
    const Result<backends::Drawn> drawn = draw_promised(clip, backend);
    if (!drawn) return tl::unexpected(drawn.error());
    all.see(part, drawn->fragments);
  }
  return all.finish();
}

const LawRegistration kRegistration(
    {.id = "scissors-that-part-the-window-part-what-is-drawn",
     .sentence = "scissors that part the window part what is drawn",
     .reason = "A scissor is a test of pixels that nothing else of a fragment depends on.",
     .exceptions = "nothing: every case has something to say",
     .generate = &generate_any,
     .check = &check,
     .takes_lines_and_points = true,
     .covers = {cover(14, "clipped"), cover(37, "parted"), cover(6, "scissor"),
                cover(18, "several samples"), cover(9, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::scissors_part_the_window_law
