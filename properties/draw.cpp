#include "properties/draw.h"

#include <rapidcheck/Random.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "properties/float_numbers.h"

namespace rastercheck::properties {
namespace {

constexpr int kSizes = 101;

const cases::Capabilities& everything() {
  static const cases::Capabilities kEverything;
  return kEverything;
}

}  // namespace

struct Draw::State {
  rc::Random random;
  int size;
  const cases::Capabilities* capabilities;
};

Draw::Draw(std::uint64_t seed, std::string_view stream, std::uint64_t index,
           const cases::Capabilities& capabilities)
    : state_(std::make_unique<State>(
          State{rc::Random(rc::Random::Key{{seed, fnv1a(stream), index, 0}}),
                static_cast<int>(index % kSizes), &capabilities})) {}

Draw::Draw(std::uint64_t seed, std::string_view stream, std::uint64_t index)
    : Draw(seed, stream, index, everything()) {}

Draw::~Draw() = default;

const cases::Capabilities& Draw::capabilities() const { return *state_->capabilities; }

int Draw::size() const { return state_->size; }

std::uint64_t Draw::bits(int count) {
  assert(0 <= count && count <= 64);
  if (count == 0) return 0;
  return state_->random.next() >> (64 - count);
}

int Draw::between(int lo, int hi) {
  assert(lo <= hi);
  // Draws numbers with as many bits as the largest offset until one is in range. Taking a remainder
  // instead would favour small offsets.
  const auto most = static_cast<std::uint64_t>(std::int64_t{hi} - lo);
  const auto width = static_cast<int>(std::bit_width(most));
  std::uint64_t offset = bits(width);
  while (offset > most) offset = bits(width);
  return static_cast<int>(std::int64_t{lo} + static_cast<std::int64_t>(offset));
}

bool Draw::one_in(int n) { return between(0, n - 1) == 0; }

float Draw::unit() { return static_cast<float>(bits(24)) * 0x1p-24F; }

float Draw::uniform(float lo, float hi) {
  assert(lo <= hi);
  // Every operation is rounded once (IEEE), so results are the same everywhere. The last rounding
  // may reach hi.
  const double t = double{unit()};
  const double value = double{lo} + t * (double{hi} - double{lo});
  return std::clamp(static_cast<float>(value), lo, hi);
}

float Draw::spread(int lo, int hi) {
  assert(-149 <= lo && lo <= hi && hi <= 127);
  const int exponent = between(lo, hi);
  const int mantissa_bits = between(0, 23);
  const std::uint64_t fraction = bits(mantissa_bits);
  const bool is_negative = one_in(2);
  const double mantissa = 1.0 + static_cast<double>(fraction) * power_of_two(-mantissa_bits);
  const auto value = static_cast<float>(mantissa * power_of_two(exponent));
  return is_negative ? -value : value;
}

}  // namespace rastercheck::properties
