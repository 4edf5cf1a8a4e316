#include "rasterizer/internal/fallback_drawing.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/conservative_coverage.h"
#include "rasterizer/internal/depth_store.h"
#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/grid_coverage.h"
#include "rasterizer/internal/part_set_up.h"
#include "rasterizer/internal/primitive_drawing.h"

namespace rastercheck::rasterizer {
namespace {

/// A window position, in pixels.
struct WindowPlace {
  double u = 0;
  double v = 0;
};

template <typename Coverage>
class FallbackDrawingBy : public FallbackDrawing {
 public:
  FallbackDrawingBy(const DrawSetting& setting, const Mesh& mesh, bool has_derivatives)
      : setting_(setting),
        mesh_(mesh),
        has_derivatives_(has_derivatives),
        coverage_(setting),
        rows_(2 * setting.pattern.size()) {}

  Fate locate(std::uint32_t triangle, PixelBox& box) override {
    has_triangle_ = false;
    const std::optional<InputTriangle> input = input_triangle(setting_.state, mesh_, triangle);
    if (!input) return Fate::not_finite;
    const Fate fate = coverage_.locate(*input);
    box = coverage_.box();
    return fate;
  }

  bool begin(std::uint32_t triangle) override {
    if (has_triangle_ && triangle == triangle_) return is_drawn_;
    triangle_ = triangle;
    has_triangle_ = true;
    for (CoveredRow& row : rows_) row.y = kNoRow;
    is_drawn_ = set_up_parts(setting_.state, mesh_, triangle, has_derivatives_, coverage_,
                             parts_) == Fate::drawn;
    return is_drawn_;
  }

  Mask cover(std::size_t sample, int y, int first) override {
    return row_of(sample, y, first).covered;
  }

  void evaluate(const LanePlace& place, const LaneOutput& out) override {
    const SampleInPart sample = sample_in_part(place);
    out.depth[out.lane] = depth_of(sample);
    for (std::size_t a = 0; a < setting_.state.attributes.size(); ++a) {
      WindowPlace of_value = sample.at;
      const DrawnPart* part = &sample.part;
      if (is_at_sample(a)) {
        out.values[a][out.lane] = value_of(sample, a);
      } else {
        of_value = place_of(place, a);
        part = &parts_[coverage_.part_at(of_value.u, of_value.v)];
        out.values[a][out.lane] = value_at(part->values.attributes[a], part->values, part->weights,
                                           of_value.u, of_value.v);
      }
      if (out.along_u.empty()) continue;
      const DerivativeSite site =
          derivative_site(part->values, part->weights, of_value.u, of_value.v);
      const WideSlopes slopes = derivatives_at(part->derivatives, part->weights, a, site);
      out.along_u[a][out.lane] = slopes[0];
      out.along_v[a][out.lane] = slopes[1];
    }
  }

  bool is_front() const override { return coverage_.is_front(); }

  float depth(const LanePlace& place) override { return depth_of(sample_in_part(place)); }

  double reciprocal_w(const LanePlace& place) override {
    const DrawnPart& part = parts_[part_of(place)];
    if (part.is_flat) {
      return 1 / double{part.source.positions[provoking_vertex(setting_.state)].w};
    }
    const WindowPlace at = sample_at(place);
    return exact_reciprocal_w_at(part.weights, at.u, at.v);
  }

  double floor(const LanePlace& place, std::size_t attribute, double scale,
               double period) override {
    const WindowPlace at = place_of(place, attribute);
    const std::size_t index =
        is_at_sample(attribute) ? part_of(place) : coverage_.part_at(at.u, at.v);
    const DrawnPart& part = parts_[index];
    return exact_floor_at(part.values.attributes[attribute], part.values, part.weights, at.u, at.v,
                          scale, period);
  }

 private:
  static constexpr int kNoRow = -1;

  /// The samples of one index that the triangle covers in kBlockSize pixels of a row.
  struct CoveredRow {
    int y = kNoRow;
    int first = 0;
    Mask covered = 0;
    Mask at_vertex = 0;       ///< CoveredBlock::at_vertex
    std::vector<Mask> parts;  ///< [part]: samples drawn with the part
  };

  /// Returns the coverage of a row. Computes it unless the row is among the last that were covered.
  const CoveredRow& row_of(std::size_t sample, int y, int first) {
    CoveredRow& row = rows_[2 * sample + static_cast<std::size_t>(y & 1)];
    if (row.y == y && row.first == first) return row;
    row.y = y;
    row.first = first;
    row.covered = 0;
    row.at_vertex = 0;
    row.parts.assign(parts_.size(), 0);
    const bool is_touched =
        coverage_.box().rows.contains(y) && setting_.bounds.sample_rows[sample].contains(y);
    if (!is_touched) return row;
    const PixelRange box = intersection({first, first + kBlockSize}, coverage_.box().columns);
    if (box.empty()) return row;
    CoveredBlock block = coverage_.cover(sample, y, box.begin, box.end - box.begin, weights_);
    block.keep(columns_mask(box, box.begin));
    const int shift = box.begin - first;
    row.covered = block.covered << shift;
    row.at_vertex = block.at_vertex << shift;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      row.parts[k] = (coverage_.part_mask(block, k) & block.covered) << shift;
    }
    return row;
  }
  const CoveredRow& row_of(std::size_t sample, const LanePlace& place) {
    return row_of(sample, place.y, place.x & ~(kBlockSize - 1));
  }
  static bool has(Mask mask, const LanePlace& place) {
    return (mask >> (place.x & (kBlockSize - 1)) & 1) != 0;
  }

  bool is_at_sample(std::size_t attribute) const {
    return setting_.pattern.size() == 1 ||
           setting_.state.attributes[attribute].location == Location::sample;
  }

  WindowPlace sample_at(const LanePlace& place) const {
    const SampleOffset& offset = setting_.pattern[place.sample];
    return {place.x + offset.x, place.y + offset.y};
  }

  /// The place where an attribute is evaluated for a sample.
  WindowPlace place_of(const LanePlace& place, std::size_t attribute) {
    if (is_at_sample(attribute)) return sample_at(place);
    SampleOffset at = kPixelCenter;
    if (setting_.state.attributes[attribute].location == Location::centroid) {
      const std::size_t samples = setting_.pattern.size();
      std::size_t first = samples;
      std::size_t covered = 0;
      for (std::size_t s = 0; s < samples; ++s) {
        if (!has(row_of(s, place).covered, place)) continue;
        first = std::min(first, s);
        ++covered;
      }
      // The pixel of a helper may have no covered sample.
      if (covered > 0 && covered < samples) at = setting_.pattern[first];
    }
    return {place.x + at.x, place.y + at.y};
  }

  /// The part that a sample is drawn with.
  std::size_t part_of(const LanePlace& place) {
    if (parts_.size() == 1) return 0;
    const CoveredRow& row = row_of(place.sample, place);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (has(row.parts[k], place)) return k;
    }
    const WindowPlace at = sample_at(place);
    return coverage_.part_at(at.u, at.v);
  }

  /// A sample, with the data that all its values need.
  struct SampleInPart {
    const DrawnPart& part;
    WindowPlace at;
    double u = 0;  ///< U and V of the sample (sample_frame.h)
    double v = 0;
    double sum = 0;  ///< Σ E_i
    double reciprocal = 0;
    bool is_at_vertex = false;

    double on(const Plane& plane) const { return plane.a * u + (plane.b * v + plane.c); }
  };

  SampleInPart sample_in_part(const LanePlace& place) {
    SampleInPart sample{parts_[part_of(place)], sample_at(place)};
    const SampleFrame& frame = *sample.part.weights.frame;
    sample.u = frame.u.at(sample.at.u);
    sample.v = frame.v.at(sample.at.v);
    sample.is_at_vertex = has(row_of(place.sample, place).at_vertex, place);
    if (!sample.part.values.has_smooth) return sample;
    sample.sum = sample.on(sample.part.values.sum);
    sample.reciprocal = 1 / sample.sum;
    return sample;
  }

  float depth_of(const SampleInPart& sample) const {
    const TriangleValues& values = sample.part.values;
    if (!values.has_constant_depth && !values.certificates.depth_is_certain) {
      return stored(exact_depth_at(values, sample.part.weights, sample.at.u, sample.at.v),
                    values.depth.steps);
    }
    const double depth = sample.on(values.depth.plane);
    return stored(std::min(std::max(depth, values.depth.least), values.depth.greatest),
                  values.depth.steps);
  }

  /// The value of an attribute at the sample itself. Uses the operations of fragment_drawing.cpp.
  double value_of(const SampleInPart& sample, std::size_t attribute) const {
    const TriangleValues& values = sample.part.values;
    const ValueLine& line = values.attributes[attribute];
    if (line.kind == ValueLine::Kind::copied) return line.copy;
    const bool is_smooth = line.kind == ValueLine::Kind::smooth;
    const bool is_certain = is_smooth ? sample.sum > values.certificates.least_sum
                                      : values.certificates.affine_is_certain;
    if (sample.is_at_vertex || !is_certain) {
      return exact_value_at(line, sample.part.weights, sample.at.u, sample.at.v);
    }
    return is_smooth ? sample.on(line.plane) * sample.reciprocal : sample.on(line.plane);
  }

  const DrawSetting& setting_;
  const Mesh& mesh_;
  bool has_derivatives_;
  Coverage coverage_;
  BlockWeights weights_;  ///< set by Coverage::cover()
  /// [sample][y & 1]: the last even row and the last odd row. A cell has one of each.
  std::vector<CoveredRow> rows_;
  std::vector<DrawnPart> parts_;
  bool has_triangle_ = false;
  bool is_drawn_ = false;
  std::uint32_t triangle_ = 0;
};

}  // namespace

std::unique_ptr<FallbackDrawing> make_fallback_drawing(const DrawSetting& setting, const Mesh& mesh,
                                                       bool has_derivatives) {
  if (setting.state.primitive != Primitive::triangles) return make_primitive_drawing(setting, mesh);
  if (setting.state.snapping) {
    return std::make_unique<FallbackDrawingBy<GridCoverage>>(setting, mesh, has_derivatives);
  }
  if (setting.state.conservative != Conservative::off) {
    return std::make_unique<FallbackDrawingBy<ConservativeCoverage>>(setting, mesh,
                                                                     has_derivatives);
  }
  return std::make_unique<FallbackDrawingBy<ExactCoverage>>(setting, mesh, has_derivatives);
}

}  // namespace rastercheck::rasterizer
