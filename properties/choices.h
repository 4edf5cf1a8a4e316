#pragma once

// The choices that a law makes, such as where to cut a triangle or how far to move it. All choices
// derive from a number that belongs to the case, so that a saved or shrunk case is checked with the
// same choices.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/case.h"

namespace rastercheck::properties {

/// Returns the case's own number (Case::choices), or else a hash of its numbers. The result does
/// not depend on the case's name and survives writing the case to a file and reading it back.
std::uint64_t choices_of(const cases::Case& c);

/// Derives successive choices from a case's number.
class Choices {
 public:
  explicit Choices(std::uint64_t hash) : rest_(hash) {}

  std::size_t below(std::size_t count) {
    const auto chosen = static_cast<std::size_t>(rest_ % count);
    rest_ /= count;
    return chosen;
  }
  template <typename T, std::size_t N>
  const T& pick(const std::array<T, N>& all) {
    return all[below(N)];
  }

 private:
  std::uint64_t rest_;
};

/// Picks at most `most` elements, evenly spread.
template <typename T>
std::vector<T> some_of(const std::vector<T>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> some;
  for (std::size_t k = 0; k < most; ++k) {
    // Picks one from each of `most` equal stretches, at varying offsets, so that not every pick is
    // the same sample of its pixel.
    const std::size_t begin = k * all.size() / most;
    const std::size_t end = (k + 1) * all.size() / most;
    some.push_back(all[begin + k % (end - begin)]);
  }
  return some;
}

}  // namespace rastercheck::properties
