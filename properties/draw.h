#pragma once

// Random choices that come out the same on every machine and compiler: what generators are written
// in. One choice per statement: `f(draw.bits(1), draw.bits(1))` has no order of its own.
//
// Behind it stands RapidCheck's splittable generator (draw.cpp is the only file that knows it). No
// choice goes through libm or the standard library's distributions.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "cases/capabilities.h"
#include "cases/digest.h"

namespace rastercheck::properties {

using cases::fnv1a;

class Draw {
 public:
  /// The choices of case `index` of a stream with a name, for a backend that draws so much, which
  /// outlives them: they depend on these four alone.
  Draw(std::uint64_t seed, std::string_view stream, std::uint64_t index,
       const cases::Capabilities& capabilities);
  /// For a backend that draws everything.
  Draw(std::uint64_t seed, std::string_view stream, std::uint64_t index);
  Draw(const Draw&) = delete;
  Draw& operator=(const Draw&) = delete;
  ~Draw();

  /// Says what the case may ask for.
  const cases::Capabilities& capabilities() const;

  /// How far to go, 0…100 (the index mod 101): how many triangles, how far out exponents reach.
  int size() const;

  /// A number of `count` random bits, 0…64.
  std::uint64_t bits(int count);
  /// lo <= n <= hi, all equally likely.
  int between(int lo, int hi);
  /// True once in `n` times.
  bool one_in(int n);
  /// A multiple of 2^-24 in [0, 1).
  float unit();
  /// About evenly spread over [lo, hi], both float32 and their difference finite; never beyond.
  float uniform(float lo, float hi);
  /// ±m · 2^e with lo <= e <= hi, m in [1, 2) of 24 random bits, or fewer: short mantissas are as
  /// likely as long ones. lo >= -149, hi <= 127; subnormals come out rounded to a float32.
  float spread(int lo, int hi);

  template <typename T, std::size_t N>
  const T& pick(const std::array<T, N>& choices) {
    return choices[static_cast<std::size_t>(between(0, static_cast<int>(N) - 1))];
  }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rastercheck::properties
