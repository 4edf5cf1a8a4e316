// Measures which of two fragments a depth test keeps, in cases that ask for the nearer one.
//
// Draws two triangles of constant depth over the whole window, one after the other: the nearer one
// first, then the farther one first, then two of equal depth. Which of them is left tells the
// function. If none is left, the depth buffer may begin at the wrong end, so the drawings are made
// again with one that begins at the other.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using cases::KeptDepth;

constexpr float kNear = 0.25F;
constexpr float kFar = 0.75F;

/// Returns the index of the triangle that is left at most samples; empty if none is left.
std::optional<std::uint32_t> left_of(Subject& subject, float first, float second,
                                     std::optional<float> clear, records::Sureness& sureness) {
  cases::Case c = subject.base();
  c.depth_test = cases::DepthTest::less;
  c.depth_clear = clear;
  for (const float depth : {first, second}) {
    const float z = c.rules == cases::Rules::opengl ? 2 * depth - 1 : depth;
    const cases::ClipVertex corner = at_window(c, {1, 1}, z, 1);
    const cases::ClipVertex right = at_window(c, {63, 1}, z, 1);
    add_triangle(c, corner, right, at_window(c, {1, 63}, z, 1));
  }
  const std::optional<cases::Fragments> drawn = subject.draw(c);
  if (!drawn) return std::nullopt;
  std::array<std::uint64_t, 2> counts{};
  for (const std::uint32_t t : drawn->triangle) {
    if (t < counts.size()) ++counts[t];
  }
  if (counts[0] == 0 && counts[1] == 0) return std::nullopt;
  const std::uint32_t left = counts[1] > counts[0] ? 1 : 0;
  sureness.in_favour += counts[left];
  sureness.against += counts[1 - left];
  return left;
}

struct DepthReading {
  std::optional<KeptDepth> kept;
  bool is_drawn = false;
  records::Sureness sureness{"samples"};
};

DepthReading read_depth_test(Subject& subject, std::optional<float> clear) {
  DepthReading reading;
  const auto left = [&](float first, float second) {
    return left_of(subject, first, second, clear, reading.sureness);
  };
  const auto near_first = left(kNear, kFar);
  const auto far_first = left(kFar, kNear);
  const auto equals = left(kNear, kNear);
  reading.is_drawn = near_first || far_first || equals;
  if (!near_first || !far_first || !equals || reading.sureness.against > 0) return reading;
  const bool keeps_last = *equals == 1;
  if (*near_first == 0 && *far_first == 1) {
    reading.kept = keeps_last ? KeptDepth::less_or_equal : KeptDepth::less;
  } else if (*near_first == 1 && *far_first == 0) {
    reading.kept = keeps_last ? KeptDepth::greater_or_equal : KeptDepth::greater;
  }
  return reading;
}

const char* text_of(KeptDepth kept) {
  switch (kept) {
    case KeptDepth::less:
      return "less";
    case KeptDepth::less_or_equal:
      return "less_or_equal";
    case KeptDepth::greater:
      return "greater";
    case KeptDepth::greater_or_equal:
      break;
  }
  return "greater_or_equal";
}

}  // namespace

void measure_depth_test(Subject& subject) {
  if (!subject.capabilities().has(cases::Feature::depth_test)) return;
  const cases::Contract promised = subject.declared();
  const KeptDepth declared = promised.depth_function;
  DepthReading reading = read_depth_test(subject, std::nullopt);
  if (!reading.is_drawn) {
    reading = read_depth_test(subject, promised.is_depth_reversed() ? 1.0F : 0.0F);
  }
  const char* const measured = reading.kept       ? text_of(*reading.kept)
                               : reading.is_drawn ? "of another kind"
                                                  : "not drawn";
  subject.add("depth test", text_of(declared), measured, "", reading.sureness).contradicts =
      reading.is_drawn && reading.kept != declared;
  if (reading.kept && reading.kept != declared) {
    subject.result.terms.depth_function = reading.kept;
  }
}

}  // namespace rastercheck::properties
