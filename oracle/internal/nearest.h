#pragma once

// Which fragment a depth test `less` may leave at each sample (oracle/judge.h).

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "oracle/triangle_truth.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// What the depth test may leave at one sample.
struct NearestAnswer {
  struct Candidate {
    std::uint32_t triangle = 0;
    records::SampleVerdict decision;
  };
  /// Required or permitted, in ascending order of triangles; all others are forbidden.
  std::vector<Candidate> candidates;
  /// Some triangle has to be drawn, whichever.
  bool is_required = false;
};

/// By (y, x, sample); samples that nothing may cover are left out. Depths are compared as far as a
/// backend can know them: one is surely nearer where the two stay apart when each is moved towards
/// the other by the contract's depth bound. Not judged: which of two equal depths was drawn first.
std::map<std::tuple<int, int, int>, NearestAnswer> nearest_answers(const SceneTruth& scene);

}  // namespace rastercheck::oracle
