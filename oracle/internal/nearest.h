#pragma once

// Which fragment a depth test `less` may leave at each sample (oracle/judge.h).

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "oracle/internal/coverage_row.h"
#include "oracle/internal/depth_filter.h"
#include "oracle/internal/triangle_filter.h"
#include "oracle/triangle_truth.h"
#include "records/judgement.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// Triangles whose truth is at hand; at most so many, then all are prepared anew.
class PreparedTriangles {
 public:
  struct Prepared {
    std::shared_ptr<const TriangleTruth> truth;
    std::shared_ptr<const TriangleFilter> filter;
  };

  PreparedTriangles(const SceneTruth& scene, Level first) : scene_(&scene), first_level_(first) {}

  /// Prepares it if it is not. The answer holds until the next call.
  const Prepared& of(std::uint32_t triangle);

 private:
  static constexpr std::size_t kMost = 8192;

  const SceneTruth* scene_;
  Level first_level_;
  std::unordered_map<std::uint32_t, Prepared> prepared_;
};

/// The answers for a band of rows. What the depth test cannot leave is forgotten as soon as that is
/// certain, so that memory is bounded by the band's samples and the depths that are too near to
/// tell apart.
class NearestBand {
 public:
  /// A triangle that may be left at a sample.
  struct Candidate {
    std::uint32_t triangle = 0;
    records::SampleVerdict decision;
  };
  /// Takes a sample's candidates, required or permitted, in ascending order of triangles, and
  /// whether some triangle has to be drawn there, whichever. All others are forbidden.
  using Take = std::function<void(int y, int x, int sample, std::span<const Candidate> candidates,
                                  bool is_required)>;

  /// Rows y0 <= y < y1. All must outlive it.
  NearestBand(const SceneTruth& scene, int y0, int y1, PreparedTriangles& triangles);

  /// Adds a triangle of which the contract promises something, and that may cover pixels of the
  /// band. Others are not added: a sample that shows one is not judged further, and all other
  /// samples are judged as if it were absent.
  void add(std::uint32_t triangle, records::LevelCounts& levels);

  /// Calls take for each sample that something may cover, by y, x, sample. Depths are compared as
  /// far as a backend can know them: one is surely nearer where the two stay apart when each is
  /// moved towards the other by the contract's depth bound, and on to the next step of what its
  /// depth tests compare. Not judged: which of two equal depths was drawn first. What is not surely
  /// nearer than the depth buffer's beginning does not have to be drawn.
  void for_each_answer(const Take& take);

 private:
  /// A triangle that covers a sample, or may.
  struct Covering {
    std::uint32_t triangle = 0;
    records::SampleVerdict decision;
    /// Around the depths that a backend may compute; not a number where any is right.
    records::Enclosure depth;
  };
  struct Sample {
    boost::container::small_vector<Covering, 1> coverings;  ///< not surely behind a required one
    bool is_required = false;
    /// Greater depths are surely behind a required one, or no nearer than the buffer's beginning.
    double horizon = 0;
  };
  struct Rival;

  void add(Sample& sample, const Covering& covering) const;
  records::Enclosure depth_of(const PreparedTriangles::Prepared& triangle,
                              const DepthFilter& filter, double slack, int x, int y, int s) const;
  /// Says whether something has to be drawn there.
  bool resolve(const Sample& sample, int y, int x, int s, std::vector<Candidate>& candidates);

  const SceneTruth* scene_;
  int y0_;
  int y1_;
  /// Depths that are surely nearer pass the depth test of an empty buffer.
  double clear_depth_;
  PreparedTriangles* triangles_;
  std::vector<Sample> samples_;
  CoverageRow row_;
};

}  // namespace rastercheck::oracle
