#pragma once

// Code that the tests of generators share: makes their cases, and counts what the cases reach, by
// the exact oracle.

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "cases/exact_contract.h"
#include "oracle/triangle_truth.h"
#include "properties/draw.h"
#include "properties/generator.h"

namespace rastercheck::properties {

/// Case `index` of a generator, with seed 1.
inline cases::Case make_case(std::string_view generator, std::uint64_t index) {
  Draw draw(1, generator, index);
  return find_generator(generator)->make(draw);
}

using Corners = std::array<cases::ClipVertex, 3>;

inline Corners corners_of(const cases::Case& c, const cases::Triangle& triangle) {
  return {c.positions[triangle[0]], c.positions[triangle[1]], c.positions[triangle[2]]};
}

/// Window x and y of a vertex with w != 0, in pixels, computed in double.
inline std::array<double, 2> window(const cases::Case& c, const cases::ClipVertex& p) {
  const double y = double{p.y} / double{p.w} * (c.rules == cases::Rules::d3d ? -1 : 1);
  return {double{c.viewport.x} + (double{p.x} / double{p.w} + 1) * double{c.viewport.width} / 2,
          double{c.viewport.y} + (y + 1) * double{c.viewport.height} / 2};
}

/// The contract of the mathematical triangle, whatever the case asks for.
inline cases::Contract exact_contract(const cases::Case& c) {
  return cases::exact_contract(cases::contract_of(c));
}

/// True if `question` is true of the verdict of some sample that the triangle may cover.
inline bool any_sample(const oracle::SceneTruth& scene, std::size_t triangle,
                       const std::function<bool(const records::SampleVerdict&)>& question) {
  const oracle::TriangleTruth truth(scene, triangle);
  const oracle::PixelBox pixels = truth.pixels();
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      for (int s = 0; s < scene.source().framebuffer.samples; ++s) {
        if (question(truth.judge(x, y, s))) return true;
      }
    }
  }
  return false;
}

/// True if the contract requires some sample of a triangle.
inline bool is_drawn(const oracle::SceneTruth& scene, std::size_t triangle) {
  return any_sample(scene, triangle, [](const records::SampleVerdict& sample) {
    return sample.verdict == records::Verdict::required;
  });
}

/// True if the case has a triangle for which `question` is true and which, drawn exactly, has a
/// required sample.
inline bool draws(const cases::Case& c,
                  const std::function<bool(const cases::Triangle&)>& question) {
  const oracle::SceneTruth scene(c, exact_contract(c));
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    if (question(c.triangles[t]) && is_drawn(scene, t)) return true;
  }
  return false;
}

/// The number of a generator's first 200 cases for which `question` is true.
inline int count_cases(std::string_view generator,
                       const std::function<bool(const cases::Case&)>& question) {
  int yes = 0;
  for (std::uint64_t i = 0; i < 200; ++i) yes += question(make_case(generator, i)) ? 1 : 0;
  return yes;
}

}  // namespace rastercheck::properties
