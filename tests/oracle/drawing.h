#pragma once

// Drawings for the judge: faultless drawings, and drawings with faults of every kind.

#include <cstdint>
#include <random>
#include <vector>

#include "cases/fragments.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// Random numbers from a seed, the same on all machines.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// An integer from low to high, both included.
  int between(int low, int high) {
    const auto choices = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<int>(engine_() % choices);
  }
  bool one_in(int n) { return between(1, n) == 1; }
  template <typename T>
  T pick(std::initializer_list<T> choices) {
    return choices.begin()[between(0, static_cast<int>(choices.size()) - 1)];
  }
  /// A float of either sign with a size from 2^low to 2^(high + 1) and up to 24 significant bits.
  float real(int low, int high);

 private:
  std::mt19937_64 engine_;
};

void push(cases::Fragments& drawn, std::uint32_t triangle, int x, int y, int sample, float depth,
          const std::vector<float>& attributes);

/// The drawing of a rasterizer without error: every required fragment, each value rounded once; NaN
/// for values that are undefined.
cases::Fragments perfect(const SceneTruth& scene);

/// Every sample of the framebuffer, of every triangle, with values of 0.
cases::Fragments everything(const SceneTruth& scene);

/// The same fragments in a random order.
cases::Fragments shuffled(const cases::Fragments& drawn, Dice& dice);

/// The float `steps` floats above `value`, or below it if negative.
float moved(float value, int steps);

/// The drawing with fragments left out, repeated and misplaced, and with values that are off by a
/// few floats or are not numbers.
cases::Fragments spoiled(const SceneTruth& scene, const cases::Fragments& drawn, Dice& dice);

}  // namespace rastercheck::oracle
