#pragma once

// The depths that a depth test compares, and how far the contract lets them be from the exact ones.
// If the contract reverses depth, all depths here are negated, so that less is nearer.

#include <optional>

#include "oracle/internal/number.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/triangle_truth.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// Whose depth is compared. A contract that promises on which side of the exact depth depths lie
/// (cases::DepthError) promises the opposite of an occludee, so that both err towards `visible`.
enum class ComparedAs { drawn, occludee };

/// The largest differences between a compared depth and the exact one, in units of depth. Each is
/// the contract's bound, unless the contract excludes that side, plus one step of the contract's
/// format, because the depth may be rounded to either neighbour. If the case asks for a unorm
/// format, the differences are those before depths are stored.
template <typename Number>
struct DepthSlack {
  Number nearer;
  Number farther;
};
DepthSlack<Field> depth_slack(const TriangleSetup& triangle, ComparedAs as = ComparedAs::drawn);
/// Like depth_slack(), but in double, and no smaller.
DepthSlack<double> near_depth_slack(const TriangleSetup& triangle,
                                    ComparedAs as = ComparedAs::drawn);

/// The depths that the depth buffer may begin with: a format may round what the case names by up to
/// a step, except 0 and 1, which every format represents exactly.
records::Enclosure initial_depths(const SceneTruth& scene);

/// The depths that a backend may compare for a triangle's fragment at a sample; empty if any depth
/// is right. The sample must not be forbidden. What a unorm format stores is the double nearest to
/// k/(2^n − 1), here and below, so that equal numbers k are equal depths.
std::optional<FieldRange> compared_depths(const TriangleTruth& truth, int x, int y, int sample,
                                          ComparedAs as = ComparedAs::drawn);

/// Encloses the depths that may be compared for exact depths `depths`, which are not stored yet;
/// NaN if `slack` is.
records::Enclosure widened_depths(const SceneTruth& scene, const records::Enclosure& depths,
                                  const DepthSlack<double>& slack);

}  // namespace rastercheck::oracle
