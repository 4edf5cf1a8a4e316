// Additive blending counts overdraw: if every triangle adds one, the sum at a sample is the number
// of triangles that cover it.
//
// Why. The picture's only channel is an attribute that is 1 at all vertices. The picture is in
// float32 and cleared to 0, and no depth test hides anything. Each fragment adds exactly 1 (a flat
// attribute is a copy; a smooth one is 1 if the contract keeps constants), and sums of ones are
// exact up to 2^24. So a fragment that is lost between threads, tiles and batches, or drawn twice,
// shows as a wrong sum, however triangles overlap. The oracle bounds the right sum, triangle by
// triangle:
//
//   required there  <=  sum  <=  required or permitted there
//
// Samples: all; samples without any triangle must keep their 0. A pseudorandom choice (choices.h)
// decides whether the attribute is flat or smooth. Only backends that draw pictures are judged.

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::additive_counts_overdraw_law {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::Verdict;

/// Sums of ones are exact up to here.
constexpr std::size_t kMostTriangles = std::size_t{1} << 24;

/// How many triangles must or may be drawn at a sample.
struct Overdraw {
  std::uint32_t required = 0;
  std::uint32_t permitted = 0;
  std::uint32_t last = 0;  ///< the last of these triangles
};

/// Returns the case with the constant 1 as its only attribute.
cases::Case counting_case(const cases::Case& c, bool is_flat) {
  cases::Case counting = c;
  counting.depth_test = cases::DepthTest::none;
  counting.attributes = {{"one",
                          is_flat ? cases::Interpolation::flat : cases::Interpolation::smooth,
                          cases::Location::sample}};
  counting.attribute_values.assign(c.positions.size(), 1.0F);
  return counting;
}

cases::Pipeline counting_pipeline() {
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.blend = cases::Blend::additive;
  return pipeline;
}

class OverdrawCheck {
 public:
  OverdrawCheck(const cases::Case& c, const cases::Contract& contract,
                const cases::Picture& picture)
      : case_(&c),
        bounds_(contract.picture_bounds.value_or(cases::PictureBounds{})),
        scene_(c, contract),
        picture_(&picture),
        overdraw_(picture.depth.size()),
        tally_(c) {}

  Check run() {
    for (std::uint32_t t = 0; t < case_->triangles.size(); ++t) add(t);
    for (std::size_t at = 0; at < overdraw_.size(); ++at) compare(at);
    return tally_.finish();
  }

 private:
  void add(std::uint32_t triangle) {
    const oracle::TriangleTruth truth(scene_, triangle);
    const oracle::PixelBox pixels = truth.pixels();
    const int samples = case_->framebuffer.samples;
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        for (int s = 0; s < samples; ++s) {
          const records::SampleVerdict decision = truth.judge(x, y, s);
          if (decision.verdict == Verdict::forbidden) continue;
          const int at = (y * case_->framebuffer.width + x) * samples + s;
          see(triangle, decision, overdraw_[static_cast<std::size_t>(at)]);
        }
      }
    }
  }

  void see(std::uint32_t triangle, const records::SampleVerdict& decision, Overdraw& overdraw) {
    const bool is_required = decision.verdict == Verdict::required;
    ++(is_required ? tally_.counts().required : tally_.counts().permitted);
    ++(is_required ? overdraw.required : overdraw.permitted);
    overdraw.last = triangle;
    tally_.see(triangle);
    if (!is_required) tally_.label("permitted");
    if (decision.reason == records::Reason::tie) tally_.label("tie");
  }

  void compare(std::size_t at) {
    const Overdraw& overdraw = overdraw_[at];
    const float sum = counted(picture_->color[at]);
    const auto least = static_cast<float>(overdraw.required);
    const float most = static_cast<float>(overdraw.required + overdraw.permitted);
    if (most > 1) tally_.label("overdraw");
    if (most > 3) tally_.label("much overdraw");
    FragmentClass found = FragmentClass::correct;
    if (!std::isfinite(sum)) {
      found = class_of_wrong(sum, FragmentClass::beyond_bound);
    } else if (sum < least || sum > most) {
      found = sum < least ? FragmentClass::missing : FragmentClass::extra;
    } else if (std::trunc(sum) != sum) {
      found = FragmentClass::beyond_bound;
    }
    if (found == FragmentClass::correct) return tally_.pass(AttributeKind::coverage);
    report(at, found, sum);
  }

  /// The number of ones whose sum a colour is, if each addition may be off by float_error of what
  /// it adds; else the colour itself.
  float counted(float color) const {
    const float count = std::round(color);
    const float error = bounds_.float_error * 0x1p-24F * count * count;
    return std::abs(color - count) <= error ? count : color;
  }

  void report(std::size_t at, FragmentClass found, float sum) {
    const Overdraw& overdraw = overdraw_[at];
    cases::SamplePlace place = place_at(*picture_, at);
    place.triangle = overdraw.last;
    records::Violation violation = violation_at(
        place, found,
        fmt::format("{} required, {} permitted", overdraw.required, overdraw.permitted),
        fmt::format("triangle {} is the last that may be drawn there", overdraw.last));
    if (overdraw.required + overdraw.permitted == 0) {
      violation.note = "no triangle may be drawn there";
    }
    violation.actual = value_text(sum);
    tally_.report(violation);
  }

  const cases::Case* case_;
  cases::PictureBounds bounds_;
  oracle::SceneTruth scene_;
  const cases::Picture* picture_;
  std::vector<Overdraw> overdraw_;  ///< [y][x][sample]
  Tally tally_;
};

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (backend.picture_drawer() == nullptr || clip.triangles.size() > kMostTriangles)
    return not_applicable("the backend draws no pictures, or the case has too many triangles");
  const bool keeps_constants = backend.contract(clip).keeps_constants;
  const bool is_flat = !keeps_constants || choices_of(clip) % 2 == 0;
  const cases::Case counting = counting_case(clip, is_flat);
  const Result<cases::Picture> picture = draw_picture(counting, backend, counting_pipeline());
  if (!picture) return tl::unexpected(picture.error());
  return OverdrawCheck(counting, backend.contract(counting), *picture).run();
}

const LawRegistration kRegistration(
    {.id = "additive-blending-counts-overdraw",
     .sentence = "additive blending counts overdraw",
     .reason = "Each fragment adds exactly 1 to a float that was cleared to 0, and sums of ones "
               "are exact.",
     .exceptions = "samples where the contract leaves open which triangles cover them: the sum may "
                   "lie between; backends that draw no pictures",
     .generate = &overlapping_case,
     .check = &check,
     .is_promised = &draws_pictures,
     .unpromised = "the backend draws no pictures",
     .covers = {cover(9, "clipped"), cover(5, "much overdraw"), cover(38, "overdraw"),
                cover(17, "several samples"), cover_decided(5, "tie"), cover(6, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::additive_counts_overdraw_law
