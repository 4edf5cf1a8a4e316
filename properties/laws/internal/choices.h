#pragma once

// Choices that depend on a case alone: a law that has to choose takes them off a hash of it
// (drawn_fragments.h), so that a saved case is checked in the same way again.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rastercheck::properties {

/// Takes numbers off a hash, one after the other.
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

/// At most `most` of these, evenly spread.
template <typename T>
std::vector<T> some_of(const std::vector<T>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> some;
  for (std::size_t k = 0; k < most; ++k) {
    // One of each of as many stretches, not always the same sample of a pixel.
    const std::size_t begin = k * all.size() / most;
    const std::size_t end = (k + 1) * all.size() / most;
    some.push_back(all[begin + k % (end - begin)]);
  }
  return some;
}

}  // namespace rastercheck::properties
