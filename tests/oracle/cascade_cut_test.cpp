// Coverage of triangles that clip planes cut, by the cascade's first level: triangles behind the
// eye, beside sides of the viewport that are open, without area, or with edges far shorter than the
// target. With short edges, a small freedom at their ends becomes a large one far away.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/oracle/cascade.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::cascade_cut_test {
namespace {

/// A vertex in view, beside the view, or behind the eye.
cases::ClipVertex cut_vertex() {
  const auto w = one_of({1.0F, 1.5F, 0.37F, 4.0F, 0x1p-9F, 0.0F, -0x1p-9F, -0.5F, -2.0F});
  const auto reach = one_of({1.0F, 1.0F, 1.5F, 6.0F});
  const float x = ordinary_float(reach);
  const float y = ordinary_float(reach);
  const auto z = one_of({0.5F, 0.5F, 0.1F, 0.999F, 1.5F, -0.25F});
  const float size = w == 0 ? 1 : w;
  return {x * size, y * size, z * size, w};
}

/// A vertex a few pixels from `p`, in a target of this size.
cases::ClipVertex beside(const cases::ClipVertex& p, int size) {
  const float step = 2 / static_cast<float>(size);
  const float dx = ordinary_float(step);
  const float dy = ordinary_float(step);
  return {p.x + dx * p.w, p.y + dy * p.w, p.z, p.w};
}

/// Two vertices in view, on opposite sides, and one behind the eye or far off: three of four such
/// triangles are visible.
std::array<cases::ClipVertex, 3> seen_vertices() {
  const float left = ordinary_float(1);
  const float right = ordinary_float(1);
  const auto near = one_of({1.0F, 0.7F});
  const auto far = one_of({1.0F, 3.0F});
  const auto w = one_of({-0.5F, -2.0F, -0x1p-9F, 0x1p-9F, 1.0F, 2.0F});
  const float height = 2 + std::abs(ordinary_float(4));
  return {{{left * near, -1.1F * near, 0.5F * near, near},
           {right * far, 1.2F * far, 0.25F * far, far},
           {height * w, 0.3F * w, 0.5F * w, w}}};
}

cases::Case cut_case() {
  const auto size = one_of({6, 6, 24, 40});
  cases::ClipVertex a = cut_vertex();
  cases::ClipVertex b = *rc::gen::inRange(0, 3) == 0 ? beside(a, size) : cut_vertex();
  cases::ClipVertex c = cut_vertex();
  if (*rc::gen::arbitrary<bool>()) {
    const std::array<cases::ClipVertex, 3> seen = seen_vertices();
    a = seen[0];
    b = seen[1];
    c = seen[2];
  }
  // Triangles with exactly no area: three vertices on one line, or two in one place.
  const auto kind = *rc::gen::inRange(0, 8);
  if (kind == 0) {
    const float x = grid_float(1);
    const float y = grid_float(1);
    a = {x, y, 0.5F, 1};
    b = {-x, -y, 0.5F, 1};
    c = {0, 0, 0.5F, 1};
  }
  if (kind == 1) c = a;
  const auto rules = one_of({cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d});
  cases::Case made = small_case(rules, size, size, {a, b, c});
  made.framebuffer.samples = one_of({1, 1, 4});
  made.cull = one_of({cases::Cull::none, cases::Cull::none, cases::Cull::back});
  made.depth_clamp = *rc::gen::inRange(0, 4) == 0;
  made.viewport.x = one_of({0.0F, 0.0F, 2.0F, -3.5F});
  if (*rc::gen::inRange(0, 4) == 0) made.viewport.width -= 3;
  if (*rc::gen::inRange(0, 4) == 0) made.scissor = cases::Scissor{1, 2, 4, 30};
  made.clip_distance_count = *rc::gen::inRange(0, 4) == 0 ? 1 : 0;
  for (std::size_t i = 0; i < 3 * made.clip_distance_count; ++i) {
    made.clip_distances.push_back(grid_float(1));
  }
  cases::Snapping snapping;
  snapping.subpixel_bits = one_of({2, 4, 8});
  snapping.rounding = one_of({cases::Rounding::unspecified, cases::Rounding::nearest_even});
  snapping.position_error = one_of({0.0F, 0.02F, 3.0F});
  made.coverage = snapping;
  made.basis = one_of({cases::Basis::unspecified, cases::Basis::snapped, cases::Basis::ideal});
  return made;
}

cases::Contract cut_contract(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  contract.is_on_grid = *rc::gen::arbitrary<bool>();
  if (*rc::gen::inRange(0, 4) == 0) contract.tie_rule = cases::TieRule::unspecified;
  contract.guard_band = one_of({32768.0F, 50.0F});
  contract.viewport_error = one_of({0.0, 0.0, 0.0, 0.0625, 1.0});
  cases::TrianglePromise promise;
  promise.position_error = c.coverage->position_error;
  promise.clip_tolerance = one_of({1.0, 1.5, 20.0, 90.0});
  promise.clip_error = one_of({0.0, 0.0, 0x1p-20, 0x1p-5});
  promise.side_tolerance = one_of({0.0, 0.0, 1.0, 17.0, 300.0});
  promise.bounds = contract.bounds;
  contract.triangles = {promise};
  return contract;
}

// Kills: a sample treated as decided although a boundary of a cut triangle may still move past it,
// in any reading; a box that leaves out samples that may be drawn; samples beside open sides that
// are treated as required.
RC_GTEST_PROP(CascadeCut, LevelsGiveTheVerdictsOfEachSample, ()) {
  const cases::Case c = cut_case();
  const SceneTruth scene(c, cut_contract(c));
  const records::Counts counts = judge(scene, {}, from(Level::filter)).judgement.counts;
  RC_CLASSIFY(counts.required > 0, "required");
  RC_CLASSIFY(counts.permitted > 0, "permitted");
  const std::string wrong = wrong_verdict(scene);
  RC_ASSERT(wrong == "");
}

/// A case of cut_case() with a second triangle in front of it or behind it. The contract may leave
/// less open about the second triangle, or more.
cases::Case framed_case() {
  cases::Case c = cut_case();
  c.depth_test = cases::DepthTest::less;
  const std::array<cases::ClipVertex, 3> second = seen_vertices();
  const auto w = one_of({1.0F, 0x1p-6F, 20.0F});
  const auto z = one_of({0.5F, 0.5F, 0.3F});
  for (std::size_t i = 0; i < 3; ++i) {
    cases::ClipVertex p = second[i];
    if (i == 0) p = {p.x * w, p.y * w, z * p.w * w, p.w * w};
    c.positions.push_back(p);
  }
  c.clip_distances.resize(c.clip_distance_count * c.positions.size(), 1);
  c.triangles.push_back({3, 4, 5});
  return c;
}

// Kills: a depth that some placement may have, treated as one that no placement has.
RC_GTEST_PROP(CascadeCut, LevelsAgreeOnFrames, ()) {
  const cases::Case c = framed_case();
  cases::Contract contract = cut_contract(c);
  contract.triangles.push_back(contract.triangles.front());
  contract.triangles.back().clip_tolerance = one_of({1.0, 20.0});
  const SceneTruth scene(c, contract);
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  const cases::Fragments drawn = perfect(scene);
  RC_CLASSIFY(drawn.size() > 0, "covers something");
  const std::string difference = disagreement(scene, spoiled(scene, drawn, dice));
  RC_ASSERT(difference == "");
}

}  // namespace
}  // namespace rastercheck::oracle::cascade_cut_test
