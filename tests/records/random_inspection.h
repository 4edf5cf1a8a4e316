#pragma once

// Random inspections, for laws about their JSON. Each statement makes only one random choice,
// because compilers differ in the order of several choices in one expression.

#include <rapidcheck.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "records/inspection.h"
#include "tests/records/random_record.h"

namespace rastercheck::records {

inline std::optional<Enclosure> maybe_error() {
  if (*rc::gen::arbitrary<bool>()) return std::nullopt;
  return random_error();
}

inline std::optional<std::uint32_t> maybe_index() {
  if (*rc::gen::arbitrary<bool>()) return std::nullopt;
  return *rc::gen::arbitrary<std::uint32_t>();
}

inline std::string random_fraction() {
  return one_of<std::string>({"0", "-84/5", "[1/3, 1/2]", "12…34/5"});
}

template <typename Enum>
Enum random_enumerator() {
  return static_cast<Enum>(*rc::gen::inRange<std::size_t>(0, names_of(Enum{}).size()));
}

/// A value without NaN, which does not equal itself.
inline InspectedValue random_value() {
  InspectedValue value;
  value.attribute = maybe_index();
  if (*rc::gen::arbitrary<bool>()) {
    value.exact = random_fraction();
    value.nearest = any_finite_double();
  }
  if (*rc::gen::arbitrary<bool>()) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    value.actual = any_finite_float();
    if (*rc::gen::inRange(0, 4) == 0) value.actual = one_of<float>({kInfinity, -kInfinity});
  }
  value.scale_error = maybe_error();
  value.local_error = maybe_error();
  value.excess = maybe_error();
  value.kappa = maybe_error();
  value.kappa_d = maybe_error();
  return value;
}

/// A sample within the part that `of` inspects, whose pattern has two samples.
inline InspectedSample random_sample(const Inspection& of) {
  InspectedSample sample;
  sample.place.x = of.left + *rc::gen::inRange<std::uint32_t>(0, of.width);
  sample.place.y = of.top + *rc::gen::inRange<std::uint32_t>(0, of.height);
  sample.place.sample = *rc::gen::inRange<std::uint32_t>(0, 2);
  sample.verdict = random_enumerator<Verdict>();
  sample.reason = random_enumerator<Reason>();
  sample.is_drawn = *rc::gen::arbitrary<bool>();
  sample.distance = maybe_error();
  if (*rc::gen::arbitrary<bool>()) {
    auto& edges = sample.edges.emplace();
    for (Enclosure& edge : edges) edge = random_error();
  }
  for (auto left = *rc::gen::inRange(0, 3); left > 0; --left) {
    sample.values.push_back(random_value());
  }
  return sample;
}

inline ErrorSplit random_split() {
  ErrorSplit split;
  split.attribute = maybe_index();
  for (auto left = *rc::gen::inRange(0, 3); left > 0; --left) {
    const auto stage = random_enumerator<Stage>();
    split.parts.push_back({stage, random_error()});
  }
  split.total = random_error();
  split.is_traced = *rc::gen::arbitrary<bool>();
  return split;
}

inline std::vector<WindowPoint> random_points() {
  std::vector<WindowPoint> points(*rc::gen::inRange<std::size_t>(0, 5));
  for (WindowPoint& point : points) {
    point.x = any_finite_double();
    point.y = any_finite_double();
  }
  return points;
}

/// Chooses why the sample is inspected, and what is inspected.
inline void draw_subject(Inspection& inspection) {
  inspection.occasion = random_enumerator<Occasion>();
  inspection.law = one_of<std::string>({"a law", "a \"law\" <of> it"});
  inspection.backend = one_of<std::string>({"cpu", "method:float32"});
  inspection.counterexample = *rc::gen::arbitrary<std::uint64_t>();
  if (*rc::gen::arbitrary<bool>()) inspection.kind = random_enumerator<AttributeKind>();
  if (*rc::gen::arbitrary<bool>()) inspection.stratum = random_stratum();
  inspection.source.framebuffer = {64, 64, 1};
  inspection.source.viewport = {0, 0, 64, 64, 0, 1};
  inspection.source.positions = {{any_finite_float(), 0, 0, 1}};
  inspection.source.triangles = {{0, 0, 0}};
  inspection.pattern = {{0.5, 0.5}, {0.25, 0.75}};
  inspection.place.triangle = *rc::gen::arbitrary<std::uint32_t>();
  inspection.place.x = *rc::gen::arbitrary<std::uint32_t>();
  inspection.place.y = *rc::gen::arbitrary<std::uint32_t>();
  inspection.place.sample = *rc::gen::arbitrary<std::uint32_t>();
  inspection.attribute = maybe_index();
}

inline Inspection random_inspection() {
  Inspection inspection;
  draw_subject(inspection);
  if (*rc::gen::arbitrary<bool>()) {
    auto& matrix = inspection.q_matrix.emplace();
    for (auto& row : matrix) {
      for (std::string& fraction : row) fraction = random_fraction();
    }
  }
  for (auto left = *rc::gen::inRange(0, 3); left > 0; --left) {
    inspection.outlines.push_back(random_points());
  }
  inspection.left = *rc::gen::inRange<std::uint32_t>(0, 16384);
  inspection.top = *rc::gen::inRange<std::uint32_t>(0, 16384);
  inspection.width = *rc::gen::inRange<std::uint32_t>(1, kMostInspected + 1);
  inspection.height = *rc::gen::inRange<std::uint32_t>(1, kMostInspected + 1);
  for (auto left = *rc::gen::inRange(0, 4); left > 0; --left) {
    inspection.samples.push_back(random_sample(inspection));
  }
  for (auto left = *rc::gen::inRange(0, 3); left > 0; --left) {
    inspection.splits.push_back(random_split());
  }
  if (*rc::gen::arbitrary<bool>()) inspection.coverage_stage = random_enumerator<Stage>();
  return inspection;
}

}  // namespace rastercheck::records
