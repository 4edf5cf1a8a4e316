#pragma once

// Random choices for generators, the same on every machine and compiler. Make one choice per
// statement: in `f(draw.bits(1), draw.bits(1))` the order of choices is unspecified.
//
// Uses RapidCheck's splittable generator (only draw.cpp knows RapidCheck). No choice uses libm or
// the standard library's distributions.

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
  /// Makes the choices for case `index` of a named stream. `capabilities` are those of the backend
  /// and must outlive the object. Choices depend on the four arguments alone.
  Draw(std::uint64_t seed, std::string_view stream, std::uint64_t index,
       const cases::Capabilities& capabilities);
  /// Makes the choices for a backend that draws everything.
  Draw(std::uint64_t seed, std::string_view stream, std::uint64_t index);
  Draw(const Draw&) = delete;
  Draw& operator=(const Draw&) = delete;
  ~Draw();

  /// The features and limits that the case must respect.
  const cases::Capabilities& capabilities() const;

  /// The case's size, 0…100 (the index mod 101): scales the number of triangles and the range of
  /// exponents.
  int size() const;

  /// A number of `count` random bits, 0…64.
  std::uint64_t bits(int count);
  /// A number n with lo <= n <= hi; all are equally likely.
  int between(int lo, int hi);
  /// True once in `n` times.
  bool one_in(int n);
  /// A multiple of 2^-24 in [0, 1).
  float unit();
  /// A float in [lo, hi], about evenly spread. lo, hi and their difference must be finite in
  /// float32.
  float uniform(float lo, float hi);
  /// ±m · 2^e with lo <= e <= hi and m in [1, 2) of at most 24 random bits; short mantissas are as
  /// likely as long ones. lo >= -149, hi <= 127; subnormal results are rounded to float32.
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
