#pragma once

// How one sample of a drawing came about, stage by stage, as plain data: what a backend that can
// tell says of itself (backends/backend.h).
//
//   stage        received                  handed on
//   edges        x0 y0 z0 w0 … w2          a0 b0 c0 band0 … band2, is_snapped
//   certificate  band0 band1 band2         least_sum, affine_is_certain, depth_is_certain
//   coverage     U V T                     in_double, exactly or in_whole_numbers, which is 1
//   weights      U V T                     E0 E1 E2
//   evaluation   E0 E1 E2                  depth, depth_is_exact, and of attribute number a: r[a],
//                                          r[a]_is_exact, and r[a]_u and r[a]_v where that is not
//                                          at the sample
//
// A weight is E_i = a_i U + (b_i V + c_i T), each operation rounded to double; band_i is how far it
// may be off. Whether something is so is 1 or 0. Numbers are doubles; a float32 is one, to the bit.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::records {

/// A sample of a triangle.
struct SampleAddress {
  std::uint32_t triangle = 0;  ///< index into the case's triangles
  std::uint32_t x = 0;         ///< pixels
  std::uint32_t y = 0;         ///< pixels
  std::uint32_t sample = 0;    ///< index into the sample pattern
  bool operator==(const SampleAddress&) const = default;
};

struct NamedNumber {
  std::string name;
  double value = 0;
  bool operator==(const NamedNumber&) const = default;
};
using NamedNumbers = std::vector<NamedNumber>;

struct StageTrace {
  std::string stage;
  NamedNumbers received;
  NamedNumbers handed_on;
  bool operator==(const StageTrace&) const = default;
};

struct SampleTrace {
  std::vector<StageTrace> stages;  ///< in the order they ran
  float depth = 0;
  std::vector<float> attributes;
  bool operator==(const SampleTrace&) const = default;
};

/// The stage of a name; nullptr where there is none.
const StageTrace* find_stage(const SampleTrace& trace, std::string_view stage);
/// The number of a name; nothing where there is none.
std::optional<double> find_number(const NamedNumbers& numbers, std::string_view name);

}  // namespace rastercheck::records
