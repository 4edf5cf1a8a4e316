#pragma once

// Which fragment a depth test `less` may leave at each sample (oracle/judge.h).

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "oracle/internal/triangle_filter.h"
#include "oracle/triangle_truth.h"
#include "records/judgement.h"
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

/// Triangles whose truth is at hand.
class PreparedTriangles {
 public:
  struct Prepared {
    std::shared_ptr<const TriangleTruth> truth;
    std::unique_ptr<TriangleFilter> filter;
  };

  PreparedTriangles(const SceneTruth& scene, Level first) : scene_(&scene), first_level_(first) {}

  /// Prepares it if it is not.
  const Prepared& of(std::uint32_t triangle);
  /// Forgets all.
  void clear() { prepared_.clear(); }

 private:
  const SceneTruth* scene_;
  Level first_level_;
  std::map<std::uint32_t, Prepared> prepared_;
};

/// The answers, a band of rows after the other, so that memory is bounded by what covers a band.
class NearestAnswers {
 public:
  using Answers = std::map<std::tuple<int, int, int>, NearestAnswer>;

  explicit NearestAnswers(const SceneTruth& scene);

  /// Rows of a band.
  static constexpr int kRows = 16;

  /// By (y, x, sample), for samples of rows y0 <= y < y1; samples that nothing may cover are left
  /// out. Depths are compared as far as a backend can know them: one is surely nearer where the two
  /// stay apart when each is moved towards the other by the contract's depth bound. Not judged:
  /// which of two equal depths was drawn first.
  Answers in_rows(int y0, int y1, PreparedTriangles& triangles, records::LevelCounts& levels) const;

 private:
  const SceneTruth* scene_;
  std::vector<std::pair<int, int>> rows_;  ///< [triangle]: the rows it may cover, first and past
};

}  // namespace rastercheck::oracle
