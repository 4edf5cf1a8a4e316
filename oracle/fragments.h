#pragma once

// The fragments of a case, as CONTRACT's `oracle` output lists them.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cases/sample_place.h"
#include "oracle/rational.h"
#include "oracle/triangle_truth.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// One sample of one triangle that has to be drawn, or may be.
struct Fragment {
  cases::SamplePlace place = {};
  records::SampleVerdict decision;
  std::optional<ValueRange> depth;                    ///< nothing where undefined
  std::vector<std::optional<ValueRange>> attributes;  ///< [attribute]; nothing where undefined
};

/// The values of a sample that is not forbidden; `truth` is its triangle's.
Fragment fragment_at(const SceneTruth& scene, const TriangleTruth& truth, std::size_t triangle,
                     int x, int y, int sample, const records::SampleVerdict& decision);

/// Hands every required or permitted fragment of the scene to the sink, with the truth of its
/// triangle for further questions; one that returns false stops. Ordered by triangle, y, x, sample:
/// each triangle as if drawn alone, or, with the case's depth test `less`, only what may be the
/// nearest of its sample. Without a depth test nothing is stored; with it, all fragments are.
void for_each_fragment(const SceneTruth& scene,
                       const std::function<bool(const Fragment&, const TriangleTruth&)>& sink);

}  // namespace rastercheck::oracle
