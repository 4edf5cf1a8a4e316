#pragma once

// The fragments of a case, as `rastercheck oracle` prints them (docs/commands.md).

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cases/sample_place.h"
#include "oracle/rational.h"
#include "oracle/triangle_truth.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// One sample of one triangle that must or may be drawn.
struct Fragment {
  cases::SamplePlace place = {};
  records::SampleVerdict decision;
  std::optional<ValueRange> depth;                    ///< empty if undefined
  std::vector<std::optional<ValueRange>> attributes;  ///< [attribute]; empty if undefined
};

/// Returns the fragment at a sample, which must not be forbidden. `truth` must be that of
/// `triangle`.
Fragment fragment_at(const SceneTruth& scene, const TriangleTruth& truth, std::size_t triangle,
                     int x, int y, int sample, const records::SampleVerdict& decision);

/// Passes every required or permitted fragment of the scene to the sink, with the truth of its
/// triangle for further questions; stops if the sink returns false. Order: triangle, y, x, sample.
/// Each triangle is treated as if drawn alone; with the case's depth test `less`, only fragments
/// that may be the nearest of their sample are passed. Stores all fragments first if the case has a
/// depth test; else stores none.
void for_each_fragment(const SceneTruth& scene,
                       const std::function<bool(const Fragment&, const TriangleTruth&)>& sink);

}  // namespace rastercheck::oracle
