#pragma once

// Finds the fragments that a depth test `less`, or the contract's own, may leave at each sample
// (oracle/judge.h).

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "oracle/internal/compared_depth.h"
#include "oracle/internal/coverage_row.h"
#include "oracle/internal/depth_filter.h"
#include "oracle/internal/triangle_filter.h"
#include "oracle/triangle_truth.h"
#include "records/judgement.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// A cache of triangles' truths and filters; emptied when it is full.
class PreparedTriangles {
 public:
  struct Prepared {
    std::shared_ptr<const TriangleTruth> truth;
    std::shared_ptr<const TriangleFilter> filter;
    mutable std::shared_ptr<const DepthFilter> depth_filter;  ///< made when first asked for

    const DepthFilter& depths() const;
  };

  PreparedTriangles(const SceneTruth& scene, Level first) : scene_(&scene), first_level_(first) {}

  /// Prepares the triangle unless cached. The reference holds until the next call.
  const Prepared& of(std::uint32_t triangle);

  /// Drops the triangles that have no pixels in row y or beyond it.
  void forget_rows_before(int y);

 private:
  static constexpr std::size_t kMost = 8192;

  const SceneTruth* scene_;
  Level first_level_;
  std::unordered_map<std::uint32_t, Prepared> prepared_;
};

/// Finds the answers for a band of rows. A triangle is dropped from a sample as soon as the depth
/// test certainly removes it there, so memory is bounded by the band's samples and the depths that
/// are too close to tell apart.
class NearestBand {
 public:
  /// A triangle that may be the visible one at a sample.
  struct Candidate {
    std::uint32_t triangle = 0;
    records::SampleVerdict decision;
  };
  /// Receives a sample's candidates, required or permitted, in ascending order of triangles. If
  /// `is_required`, some triangle must be drawn at the sample, no matter which. Triangles that are
  /// not candidates are forbidden.
  using Take = std::function<void(int y, int x, int sample, std::span<const Candidate> candidates,
                                  bool is_required)>;

  /// If enclosures in doubles do not tell two depths apart, `exact` compares the depths exactly;
  /// `enclosed` does not compare them further, so that either triangle may be the visible one.
  enum class Comparison { exact, enclosed };

  /// Covers the rows y0 <= y < y1. The scene and the triangles must outlive the band.
  NearestBand(const SceneTruth& scene, int y0, int y1, PreparedTriangles& triangles,
              Comparison comparison = Comparison::exact);

  /// Adds a triangle that may cover pixels of the band and about which the contract promises
  /// something. Triangles without a promise are not added: a sample that shows one is not judged
  /// further, and all other samples are judged as if that triangle were absent.
  void add(std::uint32_t triangle, records::LevelCounts& levels);

  /// Calls take for each sample that a triangle may cover, ordered by y, x, sample. Depths are
  /// compared as precisely as a backend can know them. One of two depths is certainly nearer if
  /// they stay apart after each is moved towards the other by the contract's depth bound, and then
  /// on to the next step of the depth test's format. Which of two equal depths was drawn first is
  /// judged only if the contract keeps equal depths (cases::Contract::keeps_equal_depth) and both
  /// triangles lie in one plane of constant depth: the second then fails the test. A fragment not
  /// certainly nearer than the depth buffer's initial value need not be drawn.
  void for_each_answer(const Take& take);

 private:
  /// A triangle that covers or may cover a sample.
  struct Covering {
    std::uint32_t triangle = 0;
    records::SampleVerdict decision;
    /// Encloses the depths that a backend may compute, negated if the contract reverses depth; NaN
    /// if any depth is right.
    records::Enclosure depth;
  };
  struct Sample {
    boost::container::small_vector<Covering, 1> coverings;  ///< not certainly behind a required
                                                            ///< covering
    bool is_required = false;
    /// Greater depths are certainly behind a required covering, or no nearer than the buffer's
    /// initial value.
    double horizon = 0;
  };
  struct Rival;

  void add(Sample& sample, const Covering& covering) const;
  records::Enclosure depth_of(const PreparedTriangles::Prepared& triangle,
                              const DepthFilter& filter, const DepthSlack<double>& slack, int x,
                              int y, int s) const;
  /// Returns true if some triangle must be drawn at the sample.
  bool resolve(const Sample& sample, int y, int x, int s, std::vector<Candidate>& candidates);

  const SceneTruth* scene_;
  int y0_;
  int y1_;
  /// Depths certainly nearer than all of these pass the depth test against an empty buffer.
  records::Enclosure clear_depths_;
  PreparedTriangles* triangles_;
  Comparison comparison_;
  std::vector<Sample> samples_;
  CoverageRow row_;
};

}  // namespace rastercheck::oracle
