#include "records/signed_sum.h"

#include <cmath>
#include <limits>

namespace rastercheck::records {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns the nearest double, which is off by at most half a unit in its last place.
double to_double(SignedSum::Units units) { return static_cast<double>(units); }

static_assert(static_cast<double>(SignedSum::kMostOfTerm) * SignedSum::kUnit == SignedSum::kMost);

}  // namespace

void SignedSum::add(const Enclosure& error) {
  // Written so that NaN counts as beyond, too.
  const bool is_summed = error.lo >= -kMost && error.hi <= kMost;
  if (!is_summed) {
    ++beyond_;
    return;
  }
  // Scaling by a power of two is exact except for subnormal numbers, which floor and ceil take to
  // the same integer even if scaling rounds.
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
  // Three numbers are rounded: the sum, the count if it is above 2^53, and the quotient. Each
  // rounding has a relative error of at most 2^-53, which is at most one step of doubles of that
  // size. So three steps outwards cover the roundings, and a fourth covers the products of their
  // relative errors.
  const auto outwards = [](double x, double towards) {
    for (int step = 0; step < 4; ++step) x = std::nextafter(x, towards);
    return x;
  };
  const auto n = static_cast<double>(count_);
  return Enclosure{outwards(to_double(lo_) * kUnit / n, -kInfinity),
                   outwards(to_double(hi_) * kUnit / n, kInfinity)};
}

}  // namespace rastercheck::records
