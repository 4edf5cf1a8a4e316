// Scissors that part the window part what is drawn: the four rectangles that a column and a row cut
// the scissor into, each drawn by itself, are together the whole drawing, bit for bit. Nothing is
// drawn by two of them, and nothing outside of the one that was asked for.
//
// Why. A scissor is a test of pixels (i, j), x <= i < x + width and y <= j < y + height, that
// nothing else of a fragment depends on: neither its place, nor its values, nor, with a depth test,
// which triangles meet there. OpenGL says so ("Invariance", rule 2 and its corollary: fragments do
// not change with the scissor's parameters, other than whether there is one): so the whole is drawn
// with a scissor as well, of the case's own or of the whole framebuffer.
//
// Samples: all, whatever the contract leaves open, values and derivatives too. The column and the
// row come from the case's numbers, and cut off at least a pixel where there are two.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "oracle/transform.h"
#include "properties/internal/drawn_fragments.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// Pixels begin <= i < end along an axis.
struct Range {
  int begin = 0;
  int end = 0;
};

Range visible(int size, std::int64_t begin, std::int64_t extent) {
  const auto held = [size](std::int64_t at) {
    return static_cast<int>(std::clamp(at, std::int64_t{0}, std::int64_t{size}));
  };
  return {held(begin), held(begin + extent)};
}

/// A line between two pixels of a range, if it has two.
int cut_of(const Range& range, std::uint64_t number) {
  const int size = range.end - range.begin;
  if (size < 2) return range.end;
  return range.begin + 1 + static_cast<int>(number % static_cast<std::uint64_t>(size - 1));
}

cases::Scissor rectangle(const Range& columns, const Range& rows) {
  return {columns.begin, rows.begin, std::max(columns.end - columns.begin, 0),
          std::max(rows.end - rows.begin, 0)};
}

bool is_within(const cases::Scissor& scissor, const FragmentPlace& place) {
  return std::cmp_greater_equal(place.x, scissor.x) &&
         std::cmp_less(place.x, scissor.x + scissor.width) &&
         std::cmp_greater_equal(place.y, scissor.y) &&
         std::cmp_less(place.y, scissor.y + scissor.height);
}

/// What the window is parted into.
struct Parting {
  cases::Scissor whole;
  std::array<cases::Scissor, 4> parts;
  bool is_of_case = false;  ///< whether the case has a scissor of its own
};

Parting parting_of(const cases::Case& c) {
  const cases::FramebufferSize& size = c.framebuffer;
  const cases::Scissor all = c.scissor.value_or(cases::Scissor{0, 0, size.width, size.height});
  const Range columns = visible(size.width, all.x, all.width);
  const Range rows = visible(size.height, all.y, all.height);
  const std::uint64_t number = fingerprint(c);
  const int column = cut_of(columns, number >> 32);
  const int row = cut_of(rows, number & 0xffffffffU);
  Parting parting;
  parting.is_of_case = c.scissor.has_value();
  parting.whole = rectangle(columns, rows);
  std::size_t part = 0;
  for (const Range& down : {Range{rows.begin, row}, Range{row, rows.end}}) {
    for (const Range& across : {Range{columns.begin, column}, Range{column, columns.end}}) {
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
  PartingCheck(const cases::Case& c, const Parting& parting, const cases::Framebuffer& whole)
      : case_(&c), parting_(&parting), whole_(&whole), expected_(fragments_by_place(whole)) {
    check_.judgement.errors[AttributeKind::coverage];
  }

  void see(const cases::Scissor& part, const cases::Framebuffer& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const FragmentPlace place = place_of(drawn, i);
      const auto expected = expected_.find(place);
      if (!is_within(part, place)) {
        report(violation_at(place, FragmentClass::extra, "forbidden: outside the scissor",
                            text_of(part)));
      } else if (expected == expected_.end()) {
        report(violation_at(place, FragmentClass::extra,
                            "forbidden: it is not drawn in the whole window", text_of(part)));
      } else if (!seen_.insert(place).second) {
        report(
            violation_at(place, FragmentClass::extra, "forbidden: more than once", text_of(part)));
      } else if (const auto difference =
                     find_difference(*case_, *whole_, expected->second, drawn, i,
                                     "another value than in the whole window; " + text_of(part))) {
        report(*difference);
      }
    }
    if (!drawn.triangle.empty()) ++parts_drawn_;
  }

  Check finish() {
    std::set<std::uint32_t> triangles;
    for (const auto& [place, index] : expected_) {
      if (!seen_.contains(place)) {
        report(violation_at(place, FragmentClass::missing,
                            "required: it is drawn in the whole window", "drawn in no part"));
      } else if (is_of_case(*case_, place)) {
        triangles.insert(place.triangle);
      }
    }
    check_.judgement.counts.required = expected_.size();
    auto& classes = check_.judgement.errors[AttributeKind::coverage].classes;
    classes[FragmentClass::correct] = seen_.size();
    std::set<std::string> labels;
    if (parts_drawn_ > 1) labels.emplace("parted");
    if (parting_->is_of_case) labels.emplace("scissor");
    add_state_labels(*case_, triangles, labels);
    check_.labels.assign(labels.begin(), labels.end());
    return std::move(check_);
  }

 private:
  void report(const records::Violation& violation) {
    ++check_.judgement.errors[violation.kind].classes[violation.fragment_class];
    note(check_, violation);
  }

  const cases::Case* case_;
  const Parting* parting_;
  const cases::Framebuffer* whole_;
  FragmentMap expected_;
  std::set<FragmentPlace> seen_;
  int parts_drawn_ = 0;
  Check check_;
};

Result<Check> check(const cases::Case& c, backends::Backend& backend,
                    const CheckOptions& /*options*/) {
  Result<cases::Case> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  const Parting parting = parting_of(*clip);
  clip->scissor = parting.whole;
  const Result<cases::Framebuffer> whole = draw(*clip, backend);
  if (!whole) return tl::unexpected(whole.error());
  PartingCheck all(*clip, parting, *whole);
  for (const cases::Scissor& part : parting.parts) {
    clip->scissor = part;
    const Result<cases::Framebuffer> drawn = draw(*clip, backend);
    if (!drawn) return tl::unexpected(drawn.error());
    all.see(part, *drawn);
  }
  return all.finish();
}

const LawRegistration kRegistration(
    {.name = "scissors that part the window part what is drawn",
     .reason = "A scissor is a test of pixels that nothing else of a fragment depends on.",
     .exceptions = "nothing: every case has something to say",
     .generate = &generate_any,
     .check = &check,
     .covers = {cover(14, "clipped"), cover(37, "parted"), cover(6, "scissor"),
                cover(18, "several samples"), cover(9, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties
