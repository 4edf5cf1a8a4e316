#pragma once

#include <cstddef>
#include <optional>

#include "cases/case.h"
#include "cases/contract.h"
#include "oracle/internal/triangle_setup.h"

namespace rastercheck::oracle {

/// What the contract promises of an attribute, or of the depth where there is none; 0 of flat ones.
cases::ValueBound bound_of(const cases::Contract& contract, const cases::Case& source,
                           std::optional<std::size_t> attribute);

/// g of cases::ValueBound at a point: the greatest 1/w of the triangle's vertices (of its corners
/// after clipping where some w <= 0), divided by 1/w there. Nothing where 1/w <= 0.
std::optional<Field> horizon_ratio(const TriangleSetup& triangle, const Point& p);

}  // namespace rastercheck::oracle
