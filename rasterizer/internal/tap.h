#pragma once

// What a draw shows of itself: the stages hand every intermediate result to a Tap. NoTap takes
// nothing and compiles away; RecordingTap keeps what concerns one sample.
//
// Stages, in order (rasterizer/trace.h says what each records): edges, certificate, coverage,
// weights, evaluation.

#include <cstddef>
#include <cstdint>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/standard_pattern.h"
#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

/// A row of up to 64 pixels of one sample of a triangle.
struct BlockPlace {
  std::uint32_t triangle = 0;
  std::size_t sample = 0;
  int y = 0;
  int first = 0;
  int count = 0;
};

struct NoTap {
  static void set_up(std::uint32_t /*triangle*/, const DrawnPart& /*part*/, std::size_t /*index*/) {
  }
  static void covered(const BlockPlace& /*place*/, const CoveredBlock& /*block*/) {}
  static void weighed(const BlockPlace& /*place*/, const SampleOffset& /*offset*/,
                      std::size_t /*part*/, Mask /*mask*/, const BlockWeights& /*weights*/) {}
  static void depth(const BlockPlace& /*place*/, Mask /*mask*/, bool /*is_exact*/,
                    const float* /*values*/) {}
  static void attribute(const BlockPlace& /*place*/, std::size_t /*attribute*/, Mask /*mask*/,
                        Mask /*exact*/, const float* /*values*/) {}
  static void located(const BlockPlace& /*place*/, int /*column*/, std::size_t /*attribute*/,
                      double /*u*/, double /*v*/, float /*value*/) {}
};

class RecordingTap {
 public:
  explicit RecordingTap(const SampleAddress& address) : address_(address) {}

  void set_up(std::uint32_t triangle, const DrawnPart& part, std::size_t index);
  void covered(const BlockPlace& place, const CoveredBlock& block);
  void weighed(const BlockPlace& place, const SampleOffset& offset, std::size_t part, Mask mask,
               const BlockWeights& weights);
  void depth(const BlockPlace& place, Mask mask, bool is_exact, const float* values);
  void attribute(const BlockPlace& place, std::size_t attribute, Mask mask, Mask exact,
                 const float* values);
  void located(const BlockPlace& place, int column, std::size_t attribute, double u, double v,
               float value);

  /// What was recorded; nothing where the sample is not covered.
  std::optional<Trace> trace() const;

 private:
  bool is_at(const BlockPlace& place, Mask mask) const;
  std::size_t column(const BlockPlace& place) const {
    return static_cast<std::size_t>(address_.x - place.first);
  }

  SampleAddress address_;
  struct Part {
    TracedEdges edges;
    const SampleFrame* frame = nullptr;
  };
  std::vector<Part> parts_;  ///< of the triangle
  Trace trace_;
  bool is_covered_ = false;
};

}  // namespace rastercheck::rasterizer
