// Compares the oracle's two paths: the ring path, which never divides, and the dividing path, which
// is written from the Rasterization slides.

#include "oracle/referee.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/fragments.h"
#include "oracle/transform.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::referee_test {
namespace {

std::vector<Fragment> fast_fragments(const cases::Case& c) {
  std::vector<Fragment> fragments;
  const SceneTruth scene(c, cases::contract_of(c));
  for_each_fragment(scene, [&fragments](const Fragment& f, const TriangleTruth&) {
    // The referee has no verdict for permitted samples; here these come only from the far border of
    // the viewport.
    if (f.decision.verdict == records::Verdict::required) fragments.push_back(f);
    return true;
  });
  return fragments;
}

std::vector<RefereeFragment> referee_fragments(const cases::Case& c) {
  std::vector<RefereeFragment> fragments;
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    for (int y = 0; y < c.framebuffer.height; ++y) {
      for (int x = 0; x < c.framebuffer.width; ++x) {
        for (int s = 0; s < c.framebuffer.samples; ++s) {
          if (auto fragment = referee(c, t, x, y, s)) fragments.push_back(std::move(*fragment));
        }
      }
    }
  }
  return fragments;
}

std::string text(const std::optional<Rational>& value) {
  return value ? value->to_string() : "undefined";
}

std::string text(const std::optional<ValueRange>& value) {
  return value ? value->lo.to_string() : "undefined";
}

/// Everything that a path says about a case, as text, so that a test shows where two paths differ.
template <typename Fragments>
std::string transcript(const Fragments& fragments) {
  std::string all;
  for (const auto& f : fragments) {
    all += std::to_string(f.place.triangle) + " " + std::to_string(f.place.x) + "," +
           std::to_string(f.place.y) + "/" + std::to_string(f.place.sample) + ": ";
    if constexpr (std::is_same_v<std::decay_t<decltype(f)>, Fragment>) {
      all += text(f.depth);
    } else {
      all += f.depth.to_string();
    }
    for (const auto& value : f.attributes) all += " " + text(value);
    all += "\n";
  }
  return all;
}

RC_GTEST_PROP(Referee, AgreesWithTheRingPathOnEverySampleAndValue, ()) {
  const cases::Case c = random_exact_case();
  const std::vector<Fragment> fast = fast_fragments(c);
  RC_CLASSIFY(!fast.empty(), "covers something");
  RC_ASSERT(transcript(fast) == transcript(referee_fragments(c)));
}

RC_GTEST_PROP(Referee, AgreesWithTheRingPathThroughACamera, ()) {
  cases::Case c = random_exact_case();
  c.camera.emplace();
  for (cases::Matrix4* matrix : {&c.camera->model, &c.camera->view, &c.camera->projection}) {
    for (float& element : *matrix) element = grid_float(1);
  }
  RC_ASSERT(transcript(fast_fragments(c)) == transcript(referee_fragments(c)));
}

TEST(Referee, IsNotVacuous) {
  // The Rasterization slides' triangle as a small case: half of a 4 × 4 square, 6 or 10 of 16
  // samples.
  const cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4, {{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}}},
                 {{{0}, {1}, {2}}});
  EXPECT_EQ(referee_fragments(c).size(), 6U);  // the hypotenuse belongs to the other half
  EXPECT_EQ(transcript(fast_fragments(c)), transcript(referee_fragments(c)));
}

}  // namespace
}  // namespace rastercheck::oracle::referee_test
