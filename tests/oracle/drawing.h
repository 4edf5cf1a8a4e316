#pragma once

// Drawings for the judge: faultless ones, and what can be wrong with them.

#include <cstdint>
#include <random>
#include <vector>

#include "cases/fragments.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// Numbers that one seed gives, the same on all machines.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// A whole number, both ends included.
  int between(int low, int high) {
    const auto choices = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<int>(engine_() % choices);
  }
  bool one_in(int n) { return between(1, n) == 1; }
  template <typename T>
  T pick(std::initializer_list<T> choices) {
    return choices.begin()[between(0, static_cast<int>(choices.size()) - 1)];
  }
  /// A float of either sign, 2^low to 2^(high + 1) large, with up to 24 significant bits.
  float real(int low, int high);

 private:
  std::mt19937_64 engine_;
};

void push(cases::Fragments& drawn, std::uint32_t triangle, int x, int y, int sample, float depth,
          const std::vector<float>& attributes);

/// What a rasterizer without error draws: every required fragment, each value rounded once; NaN
/// where it has none.
cases::Fragments perfect(const SceneTruth& scene);

/// Every sample of the framebuffer, of every triangle, with values of 0.
cases::Fragments everything(const SceneTruth& scene);

/// The same fragments in another order.
cases::Fragments shuffled(const cases::Fragments& drawn, Dice& dice);

/// Moves a value by so many floats.
float moved(float value, int steps);

/// The drawing with fragments left out, repeated and misplaced, and values that are off by a few
/// floats or are no numbers.
cases::Fragments spoiled(const SceneTruth& scene, const cases::Fragments& drawn, Dice& dice);

}  // namespace rastercheck::oracle
