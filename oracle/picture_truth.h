#pragma once

// Finds what a finished picture of a case may show (RULES §12): at each sample, the triangles that
// may be seen there, each with the values that may be drawn, or nothing.
//
// With the case's depth test, the candidates are those that may be the nearest (oracle/judge.h);
// without it, those that may have been drawn last. The ranges of values are outer ranges: they
// contain all values that the contract permits, and may be slightly wider where it leaves open
// where vertices are placed. So a wrong value may go unseen, but no right one is called wrong.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// The values that may be drawn: from `lo` to `hi`, both inclusive; infinite ends are unlimited.
struct ValueSpan {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool is_free = true;  ///< nothing is promised: any value, even NaN

  bool operator==(const ValueSpan&) const = default;
};

/// Lists the triangles that one sample may show.
struct SampleAnswer {
  /// A triangle that may be seen, and its depth and attributes.
  struct Candidate {
    std::uint32_t triangle = 0;
    std::span<const ValueSpan> values;  ///< the depth, then each attribute
  };
  std::span<const Candidate> candidates;
  bool may_be_empty = true;  ///< the sample may show the background
  /// Several triangles may be drawn, seen or not. Always false with Layers::seen.
  bool may_overlap = false;
};

/// The triangles that matter to a picture: those that may be seen, or, as blending mixes them, all.
enum class Layers { seen, all };

class PictureTruth {
 public:
  /// `is_wanted` is for the depth, then each attribute of the scene's case; the values of the
  /// others are free. The scene must outlive the object.
  PictureTruth(const SceneTruth& scene, std::vector<bool> is_wanted, Layers layers = Layers::seen);

  /// Receives one pixel: window x and y, and what each of its samples may show. The answers are
  /// valid only during the call.
  using TakePixel = std::function<void(int x, int y, std::span<const SampleAnswer> samples)>;

  /// Calls take for each pixel, ordered by window y, then x.
  void for_each_pixel(const TakePixel& take) const;
  /// Calls take for each pixel with y0 <= y < y1, in the same order.
  void for_each_pixel_of_rows(int y0, int y1, const TakePixel& take) const;

  /// Triangles that the contract promises nothing about: they may be drawn anywhere, and are left
  /// out of the answers.
  std::uint64_t unpromised() const { return unpromised_; }

 private:
  const SceneTruth* scene_;
  std::vector<bool> is_wanted_;
  Layers layers_;
  std::uint64_t unpromised_ = 0;
};

}  // namespace rastercheck::oracle
