#pragma once

// For laws about depth bias and unorm depths (RULES §8): their cases, and how far stored depths may
// be off.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/fragments.h"
#include "properties/law.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties {

/// A case of the generator depth-borders, or one of any other with a bias and a depth format.
Generated biased_case(Draw& draw);

/// True if a backend draws depth bias, or depths in unorm formats.
bool draws_bias_or_unorm(backends::Backend& backend);
inline constexpr std::string_view kLacksBiasAndUnorm =
    "the backend has neither depth bias nor unorm depths";

/// True if a backend draws depth bias.
bool draws_bias(backends::Backend& backend);
/// The same, if the backend's contract also allows one offset only (has_one_depth()).
bool draws_one_bias(backends::Backend& backend);
inline constexpr std::string_view kHasNoSingleBias =
    "the backend has no depth bias, or leaves open which offset it adds";

/// The case as drawn to see depths: no depth test, no attributes, and this bias.
cases::Case for_depths(const cases::Case& c, const cases::DepthBias& bias);

/// True if the contract allows each sample of the case one depth only, apart from its bounds and
/// from storing: it leaves neither positions nor the offset open.
bool has_one_depth(const cases::Case& c, const cases::Contract& contract);

/// The depths that biased or unorm depths are clamped to.
struct DepthLimits {
  double least = 0;
  double greatest = 1;

  double clamped(double depth) const;
};
DepthLimits depth_limits(const cases::Case& c);

/// How far a drawn depth may be from the exact one, by the contract's bound and by storing.
double depth_slack(const cases::Case& c, const cases::Contract& contract, double depth);

/// True if a drawn depth can be neither at nor beyond the depths that anything clamps depths to.
bool is_unclamped(const cases::Case& c, const cases::Contract& contract, double depth);

/// A lower bound on the r of the case's bias for a plane drawn at about this depth; 0 if the
/// contract allows any.
double least_bias_unit(const cases::Case& c, const cases::Contract& contract, double depth);

/// True if all vertices of the triangle have the same z/w, exactly, and no w is 0.
bool is_level(const cases::Case& c, const cases::Triangle& triangle);

/// True if a bias moves the triangle by the unit of its own plane. In float32, a vertex with w <= 0
/// counts as the far end of the depth range (RULES §8), so a constant moves a level triangle that
/// has one by another unit.
bool has_unit_of_plane(const cases::Case& c, const cases::Triangle& triangle);

/// Calls `see` for each place of the first drawing that all the others have, with its depths in
/// the drawings' order. Of fragments at one place, the first counts.
void visit_depths(const cases::Case& c, std::span<const cases::Fragments> drawings,
                  const std::function<void(const cases::SamplePlace& place,
                                           std::span<const double> depths)>& see);

/// Reports a depth that is farther from `expected` than `slack`, which is in units of depth; counts
/// it as right otherwise.
void compare_depth(Tally& tally, const cases::SamplePlace& place, double actual, double expected,
                   double slack, const std::string& note);

/// Draws several cases without promises about values of attributes. Fails if the backend does.
Result<std::vector<cases::Fragments>> draw_all(std::span<const cases::Case> cases,
                                               backends::Backend& backend);

}  // namespace rastercheck::properties
