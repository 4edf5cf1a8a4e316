#pragma once

// Two inspections as examples. Both show the triangle with the window positions (1, 1), (7, 2), (2,
// 7) in a target of 8×8 pixels; twice its area is 35. Let n_i be the cross product of the edge
// opposite corner i and the vector to the sample, with 16 units per pixel. Then the sample's
// barycentrics are n_i / 560, and if each w_i is a power of two up to 4,
//
//   e_i = n_i / (560 w_i),   u = Σ r_i n_i (4 / w_i) / Σ n_i (4 / w_i),   depth = Σ z_i n_i / 560,
//
// all made of integers. The "drawn" values are these values, rounded, with errors added by hand.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "records/inspection.h"

namespace rastercheck::reports {

class SampleInspection {
 public:
  /// `w` holds each corner's w: 1, 2 or 4. `pattern` is in 1/16 pixels.
  SampleInspection(std::array<int, 3> w, std::vector<std::array<int, 2>> pattern)
      : w_(w), pattern_(std::move(pattern)) {
    inspection_.law = "values are within bounds";
    inspection_.backend = "method:float32";
    cases::Case& source = inspection_.source;
    source.name = "a <b>bold</b> | \"case\"";
    source.framebuffer = {kSize, kSize, static_cast<int>(pattern_.size())};
    source.viewport = {0, 0, kSize, kSize, 0, 1};
    source.attributes = {{"u & v"}};
    source.triangles = {{0, 1, 2}};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto scale = static_cast<float>(w[i]);
      const auto ndc = [scale](int window) { return (static_cast<float>(window) / 4 - 1) * scale; };
      source.positions.push_back(
          {ndc(kCorners[i][0]), ndc(kCorners[i][1]), static_cast<float>(i + 1) / 4 * scale, scale});
      source.attribute_values.push_back(static_cast<float>(i));
    }
    for (const auto& [x, y] : pattern_) inspection_.pattern.push_back({x / 16.0, y / 16.0});
    inspection_.q_matrix = {
        {{"-1/7", "-1/7", "9/7"}, {"6/35", "-1/35", "-1/7"}, {"-1/35", "6/35", "-1/7"}}};
    inspection_.outlines = {{{1, 1}, {7, 2}, {2, 7}}};
    inspection_.width = inspection_.height = kSize;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) add_pixel(x, y);
    }
  }

  records::InspectedSample& at(std::uint32_t x, std::uint32_t y, std::uint32_t sample = 0) {
    return inspection_.samples[(y * kSize + x) * pattern_.size() + sample];
  }

  /// Changes the drawn value by so many scale ULP.
  static void err(records::InspectedValue& value, double units) {
    const double unit = value.attribute ? 0x1p-22 : 0x1p-24;
    value.actual = static_cast<float>(*value.nearest + units * unit);
    const double error = *value.actual - *value.nearest;
    const double local = std::exp2(std::floor(std::log2(*value.nearest)) - 23);
    value.scale_error = {error / unit, error / unit};
    value.local_error = {error / local, error / local};
    value.excess = value.scale_error;
  }

  records::Inspection& inspection() { return inspection_; }

 private:
  static constexpr int kSize = 8;
  static constexpr std::array<std::array<int, 2>, 3> kCorners{{{1, 1}, {7, 2}, {2, 7}}};

  static std::string fraction(std::int64_t n, std::int64_t d) {
    const std::int64_t common = std::gcd(n, d);
    if (d == common) return std::to_string(n / common);
    return std::to_string(n / common) + "/" + std::to_string(d / common);
  }

  static records::InspectedValue value_of(std::int64_t n, std::int64_t d) {
    records::InspectedValue value;
    value.exact = fraction(n, d);
    value.nearest = static_cast<double>(n) / static_cast<double>(d);
    value.kappa = {1, 1};
    value.kappa_d = {2.5, 2.75};
    return value;
  }

  void add_pixel(int x, int y) {
    for (std::size_t i = 0; i < pattern_.size(); ++i) {
      records::InspectedSample sample;
      sample.place.x = static_cast<std::uint32_t>(x);
      sample.place.y = static_cast<std::uint32_t>(y);
      sample.place.sample = static_cast<std::uint32_t>(i);
      fill(sample, x * 16 + pattern_[i][0], y * 16 + pattern_[i][1]);
      inspection_.samples.push_back(sample);
    }
  }

  /// Fills in the sample at that place, given in 1/16 pixels.
  void fill(records::InspectedSample& sample, int u, int v) const {
    std::array<std::int64_t, 3> n{};
    double distance = -100;
    bool is_inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& from = kCorners[(i + 1) % 3];
      const auto& to = kCorners[(i + 2) % 3];
      const int dx = to[0] - from[0];
      const int dy = to[1] - from[1];
      n[i] = dx * (v - 16 * from[1]) - dy * (u - 16 * from[0]);
      is_inside = is_inside && n[i] > 0;
      distance = std::max(distance, -static_cast<double>(n[i]) / 16 / std::hypot(dx, dy));
    }
    auto& edges = sample.edges.emplace();
    for (std::size_t i = 0; i < 3; ++i) {
      const double edge = static_cast<double>(n[i]) / (560.0 * w_[i]);
      edges[i] = {edge, edge};
    }
    sample.distance = {std::abs(distance), std::abs(distance)};
    if (!is_inside) return;
    sample.verdict = records::Verdict::required;
    sample.reason = records::Reason::inside;
    sample.is_drawn = true;
    sample.values = values_of(n);
  }

  std::vector<records::InspectedValue> values_of(const std::array<std::int64_t, 3>& n) const {
    std::int64_t numerator = 0;
    std::int64_t denominator = 0;
    std::int64_t depth = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto index = static_cast<std::int64_t>(i);
      numerator += index * n[i] * (4 / w_[i]);
      denominator += n[i] * (4 / w_[i]);
      depth += (index + 1) * n[i];
    }
    std::vector<records::InspectedValue> values{value_of(depth, 2240),
                                                value_of(numerator, denominator)};
    values[1].attribute = 0;
    for (records::InspectedValue& value : values) err(value, 0);
    return values;
  }

  std::array<int, 3> w_;
  std::vector<std::array<int, 2>> pattern_;
  records::Inspection inspection_;
};

/// The inspection of the run's first counterexample: a wrong value at (3, 4), a missing sample, an
/// extra one, one that may be drawn or not, and values that are not finite.
inline records::Inspection sample_counterexample_inspection() {
  using namespace records;
  SampleInspection made({1, 1, 1}, {{8, 8}});
  Inspection& inspection = made.inspection();
  inspection.counterexample = 0;
  inspection.place.x = 3;
  inspection.place.y = 4;
  inspection.attribute = 0;
  SampleInspection::err(made.at(3, 4).values[1], 5.25);
  SampleInspection::err(made.at(2, 4).values[1], -2);
  SampleInspection::err(made.at(3, 3).values[0], 40);
  made.at(2, 5).is_drawn = false;
  for (InspectedValue& value : made.at(2, 5).values) {
    value.actual.reset();
    value.scale_error = value.local_error = value.excess = std::nullopt;
  }
  InspectedSample& extra = made.at(5, 4);
  extra.is_drawn = true;
  extra.values = made.at(4, 3).values;
  InspectedSample& either = made.at(1, 1);
  either.verdict = Verdict::permitted;
  either.reason = Reason::snapping;
  InspectedValue& infinite = made.at(4, 2).values[1];
  infinite.actual = std::numeric_limits<float>::infinity();
  infinite.scale_error = infinite.local_error = infinite.excess = std::nullopt;
  inspection.splits = {{std::nullopt,
                        {{Stage::set_up, {0, 0}}, {Stage::rounding, {0.25, 0.25}}},
                        {0.25, 0.25},
                        true},
                       {0,
                        {{Stage::transform, {0, 0}},
                         {Stage::snap, {-0.75, -0.75}},
                         {Stage::set_up, {6.5, 6.5}},
                         {Stage::evaluation, {-0.625, -0.625}},
                         {Stage::rounding, {0.125, 0.125}}},
                        {5.25, 5.25},
                        true}};
  return inspection;
}

/// The inspection of the worst error of a stratum, with two samples per pixel and w from 1 to 4.
inline records::Inspection sample_worst_inspection() {
  using namespace records;
  SampleInspection made({1, 2, 4}, {{12, 12}, {4, 4}});
  Inspection& inspection = made.inspection();
  inspection.occasion = Occasion::worst;
  inspection.kind = AttributeKind::smooth;
  inspection.stratum = Stratum::near_horizon;
  inspection.q_matrix.reset();
  inspection.place.x = 4;
  inspection.place.y = 3;
  inspection.place.sample = 1;
  inspection.attribute = 0;
  SampleInspection::err(made.at(4, 3, 1).values[1], 0.5);
  inspection.splits = {
      {0, {{Stage::left_open, {-0.25, -0.25}}, {Stage::excess, {0.75, 0.75}}}, {0.5, 0.5}, false}};
  return inspection;
}

}  // namespace rastercheck::reports
