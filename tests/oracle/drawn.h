#pragma once

// The first triangle of a case and its exact answers, with short accessors for hand-checked tests.

#include <string>
#include <utility>
#include <vector>

#include "cases/case.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// For one sample per pixel, under the contract that the case itself asks for.
struct Drawn {
  explicit Drawn(const cases::Case& c) : scene(c, cases::contract_of(c)), triangle(scene, 0) {}

  bool covers(int x, int y) const {
    return triangle.judge(x, y, 0).verdict == records::Verdict::required;
  }
  /// The covered pixels (x, y), row by row.
  std::vector<std::pair<int, int>> pixels() const {
    std::vector<std::pair<int, int>> covered;
    for (int y = 0; y < scene.source().framebuffer.height; ++y) {
      for (int x = 0; x < scene.source().framebuffer.width; ++x) {
        if (covers(x, y)) covered.emplace_back(x, y);
      }
    }
    return covered;
  }
  Field value(std::size_t attribute, int x, int y) const {
    return to_field(triangle.attribute(attribute, x, y, 0).value().lo);
  }
  std::string text(std::size_t attribute, int x, int y) const {
    return triangle.attribute(attribute, x, y, 0).value().lo.to_string();
  }
  Field depth(int x, int y) const { return to_field(triangle.depth(x, y, 0).value().lo); }
  ProjectiveMap map() const {
    return ProjectiveMap({scene.scene().window_column(0), scene.scene().window_column(1),
                          scene.scene().window_column(2)});
  }

  SceneTruth scene;
  TriangleTruth triangle;
};

}  // namespace rastercheck::oracle
