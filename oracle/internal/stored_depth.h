#pragma once

// Depths as a unorm format of n bits stores them (RULES §8): as integers k of steps 1/(2^n − 1).
// Errors of such depths are in steps. Where a contract leaves the depth before storing open, the
// integers that its depths may become count as open as well. Otherwise the contract's reach
// (cases::DepthStore) counts as part of the bound.

#include <optional>

#include "cases/contract.h"
#include "oracle/internal/number.h"
#include "oracle/internal/ulp_error.h"

namespace rastercheck::oracle {

struct TriangleSetup;

/// 2^bits − 1.
double steps_of(int bits);

/// The k of a depth that was handed over as the float32 nearest to k/(2^bits − 1); empty if it is
/// not such a float32.
std::optional<double> stored_number(float depth, int bits);
/// The float32 nearest to k/(2^bits − 1).
float stored_float(double k, int bits);

/// The largest distance, in steps, that the contract allows between a depth and what it is stored
/// as.
Fraction exact_reach(cases::DepthStore store);

/// The range of k that depths from lo to hi may be stored as.
struct StoredRange {
  double least = 0;
  double greatest = 0;
};
StoredRange stored_range(const Field& lo, const Field& hi, int bits, cases::DepthStore store);

/// True if the contract leaves open what depths the triangle has before they are stored, or says on
/// which side of the exact ones they lie, which storing them need not keep.
bool has_open_depths(const TriangleSetup& triangle);

}  // namespace rastercheck::oracle
