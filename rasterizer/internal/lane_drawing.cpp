#include "rasterizer/internal/lane_drawing.h"

#include <algorithm>
#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/grid_coverage.h"
#include "rasterizer/internal/part_set_up.h"

namespace rastercheck::rasterizer {
namespace {

/// A window position, in pixels.
struct WindowPlace {
  double u = 0;
  double v = 0;
};

template <typename Coverage>
class LaneDrawingBy : public LaneDrawing {
 public:
  LaneDrawingBy(const DrawSetting& setting, const Mesh& mesh, bool has_derivatives)
      : setting_(setting), mesh_(mesh), has_derivatives_(has_derivatives), coverage_(setting) {}

  bool begin(std::uint32_t triangle) override {
    if (has_triangle_ && triangle == triangle_) return is_drawn_;
    triangle_ = triangle;
    has_triangle_ = true;
    is_drawn_ = set_up_parts(setting_.state, mesh_, triangle, has_derivatives_, coverage_,
                             parts_) == Fate::drawn;
    return is_drawn_;
  }

  bool touches(int y) const override { return coverage_.box().rows.contains(y); }

  CoveredBlock cover(std::size_t sample, int y, const PixelRange& columns) override {
    if (!setting_.bounds.sample_rows[sample].contains(y)) return {};
    const PixelRange box = intersection(columns, coverage_.box().columns);
    if (box.empty()) return {};
    CoveredBlock block = coverage_.cover(sample, y, box.begin, box.end - box.begin, weights_);
    block.keep(columns_mask(box, box.begin));
    const int shift = box.begin - columns.begin;
    block.covered <<= shift;
    block.at_vertex <<= shift;
    return block;
  }

  void evaluate(const LanePlace& place, const LaneOutput& out) override {
    const DrawnPart& of_sample = parts_[part_of(place)];
    out.depth[out.lane] = depth_at(of_sample, sample_at(place));
    for (std::size_t a = 0; a < setting_.state.attributes.size(); ++a) {
      const WindowPlace of_value = place_of(place, a);
      const DrawnPart& part_of_value =
          is_at_sample(a) ? of_sample : parts_[coverage_.part_at(of_value.u, of_value.v)];
      out.values[a][out.lane] = value_of(part_of_value, place, a, of_value);
      if (out.along_u.empty()) continue;
      const DerivativeSite site =
          derivative_site(part_of_value.values, part_of_value.weights, of_value.u, of_value.v);
      const WideSlopes slopes =
          derivatives_at(part_of_value.derivatives, part_of_value.weights, a, site);
      out.along_u[a][out.lane] = slopes[0];
      out.along_v[a][out.lane] = slopes[1];
    }
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
  bool is_at_sample(std::size_t attribute) const {
    return setting_.pattern.size() == 1 ||
           setting_.state.attributes[attribute].location == Location::sample;
  }

  WindowPlace sample_at(const LanePlace& place) const {
    const SampleOffset& offset = setting_.pattern[place.sample];
    return {place.x + offset.x, place.y + offset.y};
  }

  /// Where an attribute is evaluated for a sample.
  WindowPlace place_of(const LanePlace& place, std::size_t attribute) {
    if (is_at_sample(attribute)) return sample_at(place);
    SampleOffset at = kPixelCenter;
    if (setting_.state.attributes[attribute].location == Location::centroid) {
      const std::size_t samples = setting_.pattern.size();
      std::size_t first = samples;
      std::size_t covered = 0;
      for (std::size_t s = 0; s < samples; ++s) {
        if (cover(s, place.y, {place.x, place.x + 1}).covered == 0) continue;
        first = std::min(first, s);
        ++covered;
      }
      // A helper's pixel may have none that is.
      if (covered > 0 && covered < samples) at = setting_.pattern[first];
    }
    return {place.x + at.x, place.y + at.y};
  }

  /// The part that a sample is drawn with.
  std::size_t part_of(const LanePlace& place) {
    if (parts_.size() == 1) return 0;
    if (place.is_covered) {
      const CoveredBlock block = cover(place.sample, place.y, {place.x, place.x + 1});
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        if ((coverage_.part_mask(block, k) & 1) != 0) return k;
      }
    }
    const WindowPlace at = sample_at(place);
    return coverage_.part_at(at.u, at.v);
  }

  double row_of(const DrawnPart& part, const Plane& plane, const WindowPlace& at) const {
    const SampleFrame& frame = *part.weights.frame;
    return plane.a * frame.u.at(at.u) + plane.row(frame, at.v);
  }

  float depth_at(const DrawnPart& part, const WindowPlace& at) const {
    const TriangleValues& values = part.values;
    if (!values.has_constant_depth && !values.certificates.depth_is_certain) {
      return static_cast<float>(exact_depth_at(values, part.weights, at.u, at.v));
    }
    const double depth = row_of(part, values.depth.plane, at);
    return static_cast<float>(std::min(std::max(depth, values.depth.least), values.depth.greatest));
  }

  /// By the operations of drawing.cpp.
  double value_of(const DrawnPart& part, const LanePlace& place, std::size_t attribute,
                  const WindowPlace& at) const {
    const TriangleValues& values = part.values;
    const ValueLine& line = values.attributes[attribute];
    if (!is_at_sample(attribute)) return value_at(line, values, part.weights, at.u, at.v);
    if (line.kind == ValueLine::Kind::copied) return line.copy;
    if (place.is_at_vertex) return exact_value_at(line, part.weights, at.u, at.v);
    if (line.kind == ValueLine::Kind::smooth) {
      const double sum = row_of(part, values.sum, at);
      if (sum > values.certificates.least_sum) return row_of(part, line.plane, at) * (1 / sum);
    } else if (values.certificates.affine_is_certain) {
      return row_of(part, line.plane, at);
    }
    return exact_value_at(line, part.weights, at.u, at.v);
  }

  const DrawSetting& setting_;
  const Mesh& mesh_;
  bool has_derivatives_;
  Coverage coverage_;
  BlockWeights weights_;  ///< what covering leaves behind
  std::vector<DrawnPart> parts_;
  bool has_triangle_ = false;
  bool is_drawn_ = false;
  std::uint32_t triangle_ = 0;
};

}  // namespace

std::unique_ptr<LaneDrawing> make_lane_drawing(const DrawSetting& setting, const Mesh& mesh,
                                               bool has_derivatives) {
  if (setting.state.snapping) {
    return std::make_unique<LaneDrawingBy<GridCoverage>>(setting, mesh, has_derivatives);
  }
  return std::make_unique<LaneDrawingBy<ExactCoverage>>(setting, mesh, has_derivatives);
}

}  // namespace rastercheck::rasterizer
