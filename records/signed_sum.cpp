#include "records/signed_sum.h"

#include <cmath>
#include <limits>

namespace rastercheck::records {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The nearest double; its distance from the number is at most half of its last place.
double to_double(SignedSum::Units units) { return static_cast<double>(units); }

static_assert(static_cast<double>(SignedSum::kMostOfTerm) * SignedSum::kUnit == SignedSum::kMost);

}  // namespace

void SignedSum::add(const Enclosure& error) {
  // Written so that NaN is beyond as well.
  const bool is_summed = error.lo >= -kMost && error.hi <= kMost;
  if (!is_summed) {
    ++beyond_;
    return;
  }
  // Scaling by a power of two is exact, but for subnormal numbers, which floor and ceil take to the
  // same whole number either way.
  add(static_cast<Units>(std::floor(error.lo / kUnit)),
      static_cast<Units>(std::ceil(error.hi / kUnit)), 1);
}

void SignedSum::add(Units lo, Units hi, std::uint64_t count) {
  lo_ += lo;
  hi_ += hi;
  count_ += count;
}

void SignedSum::merge(const SignedSum& other) {
  add(other.lo_, other.hi_, other.count_);
  beyond_ += other.beyond_;
}

std::optional<Enclosure> SignedSum::mean() const {
  if (count_ == 0 || beyond_ > 0) return std::nullopt;
  if (lo_ == 0 && hi_ == 0) return Enclosure{0, 0};
  // Three roundings (of the sum, of the count where it is above 2^53, of the quotient), each within
  // 2^-53 of what it rounds, which is at most one step of doubles of that size: three steps, and
  // one for the products of these small numbers.
  const auto outwards = [](double x, double towards) {
    for (int step = 0; step < 4; ++step) x = std::nextafter(x, towards);
    return x;
  };
  const auto n = static_cast<double>(count_);
  return Enclosure{outwards(to_double(lo_) * kUnit / n, -kInfinity),
                   outwards(to_double(hi_) * kUnit / n, kInfinity)};
}

}  // namespace rastercheck::records
