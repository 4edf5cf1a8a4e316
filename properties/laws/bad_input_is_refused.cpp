// Bad input is refused and leaves the target untouched: in every way of drawing, a case with one
// fault gives an error, and the picture that it was to be drawn into keeps every bit.
//
// Why. A backend that draws over pictures promises both (backends::PictureContinuer), as the
// rasterizer's interface does: arguments are checked before anything is drawn. A case is bad if it
// breaks a promise of cases::Case:
//
//   mesh     an index beyond the vertices; too few or too many values or clip distances; more
//            attributes or clip distances per vertex than allowed
//   state    a viewport with a number that is not finite, or a depth outside [0, 1]; a scissor of
//            negative size
//   target   no pixels, or too many, along a side; a sample count without a pattern
//   empty    one non-finite vertex in each triangle, or a viewport of width or height 0
//
// Faults of the last kind must merely have no effect: the backend may return an error or draw no
// fragments. It may leave out a triangle that is not finite, and a triangle without area covers
// nothing. Attribute values and clip distances that are not finite are not faults: backends draw
// with them as they are.
//
// A pseudorandom number of the case (choices.h) chooses the fault and its place. The case itself is
// valid, so that it can be saved. The picture is drawn from the valid case with additive blending
// and without a depth test, so that anything that is drawn over it again shows. All samples are
// compared. Under a sanitizer the law also shows that no array is read out of bounds.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/same_picture.h"

namespace rastercheck::properties::bad_input_is_refused_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::array<float, 3> kNotFinite{kNaN, kInfinity, -kInfinity};

void spoil_index(cases::Case& c, Choices& choices) {
  const auto count = static_cast<std::uint32_t>(c.positions.size());
  cases::Triangle& triangle = c.triangles[choices.below(c.triangles.size())];
  triangle[choices.below(3)] =
      choices.pick(std::array{count, count + 1, count + 1000, 0x80000000U, 0xffffffffU});
}

void spoil_values(cases::Case& c, Choices& choices) {
  if (c.attribute_values.empty() || choices.below(4) == 0) {
    c.attribute_values.push_back(0);
  } else if (choices.below(3) == 0) {
    c.attribute_values.clear();
  } else {
    c.attribute_values.pop_back();
  }
}

void spoil_distances(cases::Case& c, Choices& choices) {
  if (c.clip_distances.empty() || choices.below(2) == 0) {
    c.clip_distances.push_back(1);
  } else {
    c.clip_distances.pop_back();
  }
}

void spoil_counts(cases::Case& c, Choices& choices) {
  if (choices.below(2) == 0) {
    c.attributes.resize(cases::kMaxAttributes + 1);
    c.attribute_values.assign(c.positions.size() * c.attributes.size(), 1);
  } else {
    c.clip_distance_count = cases::kMaxClipDistances + 1;
    c.clip_distances.assign(c.positions.size() * c.clip_distance_count, 1);
  }
}

void spoil_viewport(cases::Case& c, Choices& choices) {
  cases::Viewport& v = c.viewport;
  *choices.pick(std::array{&v.x, &v.y, &v.width, &v.height}) = choices.pick(kNotFinite);
}

void spoil_depth_range(cases::Case& c, Choices& choices) {
  constexpr float kLeast = std::numeric_limits<float>::denorm_min();
  constexpr float kBeyondOne = 1 + std::numeric_limits<float>::epsilon();
  float& depth = *choices.pick(std::array{&c.viewport.min_depth, &c.viewport.max_depth});
  depth = choices.pick(std::array{kNaN, kInfinity, -0.25F, -kLeast, 1.5F, kBeyondOne});
}

void spoil_scissor(cases::Case& c, Choices& choices) {
  cases::Scissor scissor{0, 0, c.framebuffer.width, c.framebuffer.height};
  int& size = *choices.pick(std::array{&scissor.width, &scissor.height});
  size = choices.pick(std::array{-1, -2, -size, std::numeric_limits<int>::min()});
  c.scissor = scissor;
}

void spoil_samples(cases::Case& c, Choices& choices) {
  c.framebuffer.samples =
      choices.pick(std::array{0, 3, 5, 6, 32, -1, std::numeric_limits<int>::min()});
}

void spoil_size(cases::Case& c, Choices& choices) {
  int& size = *choices.pick(std::array{&c.framebuffer.width, &c.framebuffer.height});
  size = choices.pick(std::array{0, -1, cases::kMaxSize + 1, std::numeric_limits<int>::min(),
                                 std::numeric_limits<int>::max()});
}

void spoil_positions(cases::Case& c, Choices& choices) {
  const std::size_t corner = choices.below(3);
  const std::size_t coordinate = choices.below(4);
  const float number = choices.pick(kNotFinite);
  for (const cases::Triangle& triangle : c.triangles) {
    cases::ClipVertex& p = c.positions[triangle[corner]];
    *std::array{&p.x, &p.y, &p.z, &p.w}[coordinate] = number;
  }
}

void empty_viewport(cases::Case& c, Choices& choices) {
  float& size = *choices.pick(std::array{&c.viewport.width, &c.viewport.height});
  size = choices.pick(std::array{0.0F, -0.0F});
}

/// A fault, and the function that puts it into a case.
struct Fault {
  std::string_view what;
  std::string_view label;
  bool may_draw_nothing;  ///< instead of an error
  void (*make)(cases::Case& c, Choices& choices);
};

constexpr std::array<Fault, 11> kFaults{
    {{"an index beyond the vertices", "mesh", false, &spoil_index},
     {"a wrong number of attribute values", "mesh", false, &spoil_values},
     {"a wrong number of clip distances", "mesh", false, &spoil_distances},
     {"too many attributes or clip distances of a vertex", "mesh", false, &spoil_counts},
     {"a viewport that is not finite", "state", false, &spoil_viewport},
     {"a depth range beyond [0, 1]", "state", false, &spoil_depth_range},
     {"a scissor of negative size", "state", false, &spoil_scissor},
     {"a number of samples that has no pattern", "target", false, &spoil_samples},
     {"a side of no pixels or too many", "target", false, &spoil_size},
     {"vertices that are not finite", "empty", true, &spoil_positions},
     {"a viewport without area", "empty", true, &empty_viewport}}};

/// A pipeline that adds colours, whatever the depth.
cases::Pipeline adding_pipeline(const cases::Case& c) {
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.blend = cases::Blend::additive;
  pipeline.clear_depth = 0.625F;
  const bool has_bytes = c.attributes.size() == 4 && choices_of(c) % 2 == 0;
  if (has_bytes) pipeline.format = cases::ColorFormat::rgba8;
  return pipeline;
}

class RefusalCheck {
 public:
  RefusalCheck(const cases::Case& c, const Fault& fault) : case_(&c), fault_(&fault) {
    check_.judgement.errors[AttributeKind::coverage];
    check_.labels = {std::string(fault.label)};
  }

  /// Checks one way of drawing. `count` is the number of fragments drawn if the case was not
  /// refused.
  void see(bool is_refused, std::size_t count, std::string_view how) {
    ++check_.judgement.counts.required;
    auto& classes = check_.judgement.errors[AttributeKind::coverage].classes;
    if (is_refused || (fault_->may_draw_nothing && count == 0)) {
      ++classes[FragmentClass::correct];
      return;
    }
    ++classes[FragmentClass::extra];
    records::Violation violation = violation_at(
        {}, FragmentClass::extra, "refused: " + std::string(fault_->what), std::string(how));
    violation.actual =
        fault_->may_draw_nothing ? std::to_string(count) + " fragments" : "not refused";
    add_judged_violation(check_, violation);
  }

  void see_target(const cases::Picture& before, const cases::Picture& after, bool is_refused) {
    const std::string note = "the target was written to by a case with " +
                             std::string(fault_->what) +
                             (is_refused ? ", which was refused" : ", which was not refused");
    if (before.size == after.size && before.channels == after.channels &&
        before.depth.size() == after.depth.size() && before.color.size() == after.color.size()) {
      return merge(check_, compare_pictures(*case_, before, after, note));
    }
    ++check_.judgement.errors[AttributeKind::coverage].classes[FragmentClass::extra];
    records::Violation violation =
        violation_at({}, FragmentClass::extra, "a target of the same size", note);
    violation.actual = "a target of another size";
    properties::add_judged_violation(check_, violation);
  }

  Check finish() { return std::move(check_); }

 private:
  const cases::Case* case_;
  const Fault* fault_;
  Check check_;
};

bool is_promised(backends::Backend& backend) {
  return backend.picture_drawer() != nullptr && backend.picture_continuer() != nullptr;
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  if (!is_promised(backend) || clip.triangles.empty())
    return not_applicable("the backend does not draw over pictures, or the case has no triangles");
  const cases::Pipeline pipeline = adding_pipeline(clip);
  const Result<cases::Picture> before = draw_picture(clip, backend, pipeline);
  if (!before) return tl::unexpected(before.error());

  Choices choices(choices_of(clip));
  const Fault& fault = choices.pick(kFaults);
  cases::Case bad = clip;
  fault.make(bad, choices);
  RefusalCheck refusal(clip, fault);
  // Not properties::draw(), which expects valid cases.
  const Result<backends::Drawn> drawn = backend.draw(bad);
  refusal.see(!drawn, drawn ? drawn->fragments.size() : 0, "drawn as fragments");
  const Result<cases::Picture> picture = backend.picture_drawer()->draw_picture(bad, pipeline);
  refusal.see(!picture, 0, "drawn as a picture");
  cases::Picture target = *before;
  const Result<void> over = backend.picture_continuer()->draw_over(bad, pipeline, target);
  refusal.see(!over, 0, "drawn over a picture");
  refusal.see_target(*before, target, !over);
  return refusal.finish();
}

const LawRegistration kRegistration(
    {.id = "bad-input-is-refused-and-the-target-untouched",
     .sentence = "bad input is refused and the target untouched",
     .reason = "Arguments are checked before anything is drawn.",
     .exceptions = "backends that do not draw over pictures; what is bad of single triangles may "
                   "draw nothing instead of being refused",
     .generate = &overlapping_case,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not draw over pictures",
     .covers = {cover(15, "mesh"), cover(10, "state"), cover(8, "target"), cover(8, "empty")}});

}  // namespace
}  // namespace rastercheck::properties::bad_input_is_refused_law
