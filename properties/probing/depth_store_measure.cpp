// Measures how depths are rounded to the numbers k of a unorm format of b bits, k/(2^b − 1).
//
// Draws planes of constant depth d that no format holds, and 0, 1 and 1/2. The depths are exact in
// float32 before and after every API's depth map, so k − d (2^b − 1) is the error of storing alone.
// Its range tells the rounding: ±1/2 is the nearest number, −1 to 0 the lower one.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "backends/unorm_depth.h"
#include "cases/names.h"
#include "properties/probing/depth_planes.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using cases::DepthFormat;
using cases::DepthStore;

/// Returns a depth whose fraction in a format of so many bits is near 1/2 if asked, otherwise
/// anywhere.
double unstored_depth(Draw& draw, int bits, bool near_half) {
  // OpenGL's z = 2 d − 1 holds multiples of 2^-25 below 1/2 and of 2^-24 above.
  constexpr int kBelowHalf = 1 << 24;
  constexpr int kTries = 1000;
  constexpr double kNearHalf = 0.125;
  double depth = 0;
  for (int i = 0; i < kTries; ++i) {
    depth = std::ldexp(draw.between(1, kBelowHalf - 1), -25);
    if (draw.one_in(2)) depth = 2 * depth;
    const double steps = depth * (std::ldexp(1.0, bits) - 1);
    if (!near_half || std::fabs(steps - std::floor(steps) - 0.5) < kNearHalf) break;
  }
  return depth;
}

std::vector<DepthTriangle> planes_to_store(Subject& subject, DepthFormat format,
                                           std::uint64_t part) {
  MeasureDraw draw(subject, fmt::format("rounding to {}", cases::name_of(format)), part);
  std::vector<DepthTriangle> all;
  for (const double depth : {0.0, 1.0, 0.5}) {
    all.push_back(triangle_in_cell(all.size(), depth, 0, 0));
  }
  while (all.size() < kDepthCells) {
    const double depth = unstored_depth(draw, cases::unorm_bits(format), all.size() % 2 == 0);
    all.push_back(triangle_in_cell(all.size(), depth, 0, 0));
  }
  return all;
}

struct StoreReading {
  StoredError error;                  ///< seen so far, in steps
  std::optional<std::uint32_t> half;  ///< what 1/2 is stored as
  std::uint64_t samples = 0;
  std::uint64_t no_numbers = 0;  ///< depths that the format does not have
};

StoreReading read_store(Subject& subject, DepthFormat format) {
  // One part would do; the second checks what the first one says.
  constexpr std::uint64_t kParts = 2;
  const int bits = cases::unorm_bits(format);
  const double steps = std::ldexp(1.0, bits) - 1;
  StoreReading reading;
  for (std::uint64_t part = 0; part < kParts; ++part) {
    const std::vector<DepthTriangle> triangles = planes_to_store(subject, format, part);
    const auto drawn = draw_planes(subject, triangles, {.format = format});
    for (std::size_t i = 0; drawn && i < drawn->size(); ++i) {
      ++reading.samples;
      const std::optional<std::uint32_t> k = number_of_depth(drawn->depth[i], bits);
      if (!k) {
        ++reading.no_numbers;
        continue;
      }
      const double depth = triangles[drawn->triangle[i]].depth[0];
      if (depth == 0.5) reading.half = k;
      const double error = *k - depth * steps;
      reading.error = {std::min(reading.error.least, error),
                       std::max(reading.error.greatest, error)};
    }
  }
  return reading;
}

/// The rounding that a range of errors shows. `is_any` is false if it is no rounding: a depth is a
/// step or more off.
struct SeenRounding {
  DepthStore store = DepthStore::either;
  StoredError within;  ///< what the rounding allows
  const char* words = "";
  bool is_any = true;
};

SeenRounding rounding_of(const StoredError& seen) {
  const double reach = std::max(-seen.least, seen.greatest);
  const double nearly = cases::reach_of(DepthStore::nearly_nearest);
  if (reach <= cases::reach_of(DepthStore::nearest)) {
    return {DepthStore::nearest, {-0.5, 0.5}, "the nearest"};
  }
  if (reach <= nearly) return {DepthStore::nearly_nearest, {-nearly, nearly}, "within 0.6"};
  if (reach >= 1) return {DepthStore::either, seen, "neither neighbour", false};
  if (seen.greatest == 0) return {DepthStore::either, {-1, 0}, "the lower neighbour"};
  if (seen.least == 0) return {DepthStore::either, {0, 1}, "the upper neighbour"};
  return {DepthStore::either, {-1, 1}, "either neighbour"};
}

const char* store_words(DepthStore store) {
  switch (store) {
    case DepthStore::nearest:
      return "the nearest";
    case DepthStore::nearly_nearest:
      return "within 0.6";
    case DepthStore::either:
      break;
  }
  return "either neighbour";
}

/// Adds the row of a format and returns its rounding; empty if nothing was drawn.
std::optional<SeenRounding> add_rounding(Subject& subject, DepthFormat format) {
  const std::string what = fmt::format("rounding to {}", cases::name_of(format));
  const DepthStore declared = subject.declared().depth_store;
  const StoreReading reading = read_store(subject, format);
  if (reading.samples == 0) {
    subject.add(what, store_words(declared), "not drawn");
    return std::nullopt;
  }
  SeenRounding seen = rounding_of(reading.error);
  std::string detail =
      fmt::format("{:.3f} to {:.3f} steps off", reading.error.least, reading.error.greatest);
  if (reading.half) detail += fmt::format(", 1/2 is {}", *reading.half);
  if (reading.no_numbers > 0) {
    seen.words = "not stored in the format";
    seen.is_any = false;
    seen.store = DepthStore::either;
  }
  subject
      .add(what, store_words(declared), seen.words, detail,
           sure_of("samples", reading.samples - reading.no_numbers, reading.no_numbers))
      .contradicts = !seen.is_any || seen.store > declared;
  return seen;
}

}  // namespace

std::optional<std::uint32_t> number_of_depth(float depth, int bits) {
  const double steps = std::ldexp(1.0, bits) - 1;
  const bool is_depth = depth >= 0 && depth <= 1;  // false for NaN
  if (!is_depth) return std::nullopt;
  const auto k = static_cast<std::uint32_t>(std::llround(double{depth} * steps));
  return backends::unorm_depth(k, bits) == depth ? std::optional(k) : std::nullopt;
}

void measure_depth_store(Subject& subject, Sight& sight) {
  if (!subject.capabilities().has(cases::Feature::unorm_depth)) {
    subject.add("unorm depth", kNotDeclared, "not measured", "the backend draws no such cases");
    return;
  }
  std::optional<DepthStore> store;
  for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24}) {
    const std::optional<SeenRounding> seen = add_rounding(subject, format);
    if (!seen) continue;
    sight.stored[format] = seen->within;
    store = std::max(store.value_or(DepthStore::nearest), seen->store);
  }
  if (store && *store != subject.declared().depth_store) subject.result.terms.depth_store = store;
}

}  // namespace rastercheck::properties
