#include "properties/exact_sum.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rastercheck::properties {
namespace {

constexpr std::size_t kMostTerms = 16;

/// a + b = sum + left_out, exactly (Two-Sum).
struct SumAndRest {
  SumAndRest(double a, double b) : sum(a + b) {
    const double of_b = sum - a;
    left_out = (a - (sum - of_b)) + (b - of_b);
  }
  double sum = 0;
  double left_out = 0;
};

}  // namespace

std::optional<double> exact_sum(double a, double b) {
  const SumAndRest both(a, b);
  if (both.left_out != 0) return std::nullopt;
  return both.sum;
}

bool is_float(double value) {
  return std::abs(value) <= double{std::numeric_limits<float>::max()} &&
         static_cast<double>(static_cast<float>(value)) == value;
}

// Adds the terms one by one to an expansion whose components do not overlap, so that the last
// nonzero component exceeds the sum of all before it (Shewchuk 1997, Grow-Expansion).
int sign_of_sum(std::span<const double> terms) {
  assert(terms.size() <= kMostTerms);
  std::array<double, kMostTerms> components{};
  for (std::size_t i = 0; i < terms.size(); ++i) {
    double rest = terms[i];
    for (std::size_t j = 0; j < i; ++j) {
      const SumAndRest both(rest, components[j]);
      components[j] = both.left_out;
      rest = both.sum;
    }
    components[i] = rest;
  }
  for (std::size_t i = terms.size(); i > 0; --i) {
    const double component = components[i - 1];
    if (component != 0) return component > 0 ? 1 : -1;
  }
  return 0;
}

}  // namespace rastercheck::properties
