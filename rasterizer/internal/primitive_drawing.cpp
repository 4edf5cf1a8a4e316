#include "rasterizer/internal/primitive_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "rasterizer/internal/clip_functionals.h"
#include "rasterizer/internal/grid_position.h"
#include "rasterizer/internal/line_shape.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/point_shape.h"
#include "rasterizer/internal/primitive_values.h"

namespace rastercheck::rasterizer {
namespace {

/// What a plane leaves of a line: the samples with f >= 0.
struct ClipPlane {
  ExactPlane f;
  bool keeps_zero = true;
};

/// Values of a plane at a line's two vertices, or at a point's one.
struct PlaneValues {
  std::array<Coefficient, 2> g;
  bool is_closed = true;
};

class PrimitiveDrawing : public FallbackDrawing {
 public:
  PrimitiveDrawing(const DrawSetting& setting, const Mesh& mesh) : setting_(setting), mesh_(mesh) {}

  Fate locate(std::uint32_t index, PixelBox& box) override {
    index_ = index;
    has_current_ = true;
    const Fate fate = set_up(index);
    is_drawn_ = fate == Fate::drawn;
    box = box_;
    return fate;
  }

  bool begin(std::uint32_t index) override {
    PixelBox box;
    const bool is_current = has_current_ && index == index_;
    if (!is_current) locate(index, box);
    return is_drawn_;
  }

  Mask cover(std::size_t sample, int y, int first) override {
    if (!box_.rows.contains(y)) return 0;
    PixelRange columns = intersection({first, first + kBlockSize}, box_.columns);
    if (columns.empty()) return 0;
    if (line_) columns = line_->span(columns, y);
    Mask covered = 0;
    for (int x = columns.begin; x < columns.end; ++x) {
      if (is_covered(sample, x, y)) covered |= Mask{1} << (x - first);
    }
    return covered;
  }

  void evaluate(const LanePlace& place, const LaneOutput& out) override {
    out.depth[out.lane] = depth(place);
    for (std::size_t a = 0; a < setting_.state.attributes.size(); ++a) {
      const HalfPixels at = place_of(place, a);
      out.values[a][out.lane] = values_.attribute(a, at);
      if (out.along_u.empty()) continue;
      const WideSlopes slopes = values_.slopes(a, at);
      out.along_u[a][out.lane] = slopes[0];
      out.along_v[a][out.lane] = slopes[1];
    }
  }

  bool is_front() const override { return true; }
  float depth(const LanePlace& place) override {
    return values_.depth(position(place, setting_.pattern[place.sample]));
  }
  double reciprocal_w(const LanePlace& place) override {
    return values_.reciprocal_w(position(place, setting_.pattern[place.sample]));
  }
  double floor(const LanePlace& place, std::size_t attribute, double scale,
               double period) override {
    return values_.floor(attribute, place_of(place, attribute), scale, period);
  }

 private:
  static HalfPixels position(const LanePlace& place, const SampleOffset& offset) {
    return {2 * (place.x + offset.x), 2 * (place.y + offset.y)};
  }

  /// The place where an attribute is evaluated for a sample.
  HalfPixels place_of(const LanePlace& place, std::size_t attribute) const {
    const Location location = setting_.state.attributes[attribute].location;
    const std::span<const SampleOffset> pattern = setting_.pattern;
    if (pattern.size() == 1 || location == Location::sample) {
      return position(place, pattern[place.sample]);
    }
    SampleOffset at = kPixelCenter;
    if (location == Location::centroid) {
      std::size_t first = pattern.size();
      std::size_t covered = 0;
      for (std::size_t s = 0; s < pattern.size(); ++s) {
        if (!is_covered(s, place.x, place.y)) continue;
        first = std::min(first, s);
        ++covered;
      }
      // The pixel of a helper may have no covered sample.
      if (covered > 0 && covered < pattern.size()) at = pattern[first];
    }
    return position(place, at);
  }

  bool is_covered(std::size_t sample, int x, int y) const {
    const HalfPixels p = position({sample, x, y}, setting_.pattern[sample]);
    if (point_) return point_->covers(p);
    const bool is_bresenham = setting_.state.line_mode == LineMode::bresenham;
    if (!is_bresenham) return line_->covers(p) && is_kept(p);
    return line_->selects(x, y) && is_kept(position({sample, x, y}, kPixelCenter));
  }

  bool is_kept(const HalfPixels& p) const {
    return std::all_of(clips_.begin(), clips_.end(), [&p](const ClipPlane& plane) {
      const int side = plane.f.sign(p);
      return side > 0 || (side == 0 && plane.keeps_zero);
    });
  }

  /// Makes a primitive the current one, without its values for a fate other than `drawn`.
  Fate set_up(std::uint32_t index);
  Fate set_up_line(const InputTriangle& input);
  Fate set_up_point(const InputTriangle& input);
  std::vector<PlaneValues> plane_values(const InputTriangle& input) const;
  bool may_cut(const PlaneValues& plane) const;
  ClipPlane clip_plane(const PlaneValues& plane, const LineWeights& weights) const;
  bool may_be_snapped(const InputTriangle& input, std::size_t vertices,
                      const std::vector<PlaneValues>& planes) const;

  const DrawSetting& setting_;
  const Mesh& mesh_;
  // The current primitive: a line or a point.
  std::optional<LineShape> line_;
  std::optional<PointShape> point_;
  std::vector<ClipPlane> clips_;
  PrimitiveValues values_;
  PixelBox box_;
  bool has_current_ = false;
  bool is_drawn_ = false;
  std::uint32_t index_ = 0;
};

Fate PrimitiveDrawing::set_up(std::uint32_t index) {
  line_.reset();
  point_.reset();
  clips_.clear();
  const std::optional<InputTriangle> input = input_triangle(setting_.state, mesh_, index);
  if (!input) return Fate::not_finite;
  if (setting_.is_empty()) return Fate::degenerate;
  return setting_.state.primitive == Primitive::lines ? set_up_line(*input) : set_up_point(*input);
}

/// The values of the depth planes, the viewport's sides and the clip distances.
std::vector<PlaneValues> PrimitiveDrawing::plane_values(const InputTriangle& input) const {
  const State& state = setting_.state;
  std::vector<PlaneValues> all;
  const auto add = [&](const auto& value_at, bool is_closed = true) {
    all.push_back({{value_at(0), value_at(1)}, is_closed});
  };
  const auto at = [&input](std::size_t i) -> const glm::vec4& { return input.positions[i]; };
  const auto sum = [](float a, float b) {
    const TwoSum two(a, b);
    return Coefficient{two.sum, two.error};
  };
  if (!state.depth_clamp) {
    const bool is_opengl = state.convention == Convention::opengl;
    add([&](std::size_t i) { return sum(at(i).z, is_opengl ? at(i).w : 0.0F); });
    add([&](std::size_t i) { return sum(at(i).w, -at(i).z); });
  }
  for (const glm::length_t axis : {0, 1}) {
    add([&](std::size_t i) { return sum(at(i).w, at(i)[axis]); });
    add([&](std::size_t i) { return sum(at(i).w, -at(i)[axis]); });
  }
  for (std::size_t d = 0; d < state.clip_distance_count; ++d) {
    add(
        [&](std::size_t i) {
          return Coefficient{input.distances[i][d], 0};
        },
        state.convention == Convention::d3d);
  }
  return all;
}

/// True if samples between a line's ends may be beyond the plane. A plane through an end cuts
/// nothing of Bresenham's lines, whose pixels reach beyond their ends.
bool PrimitiveDrawing::may_cut(const PlaneValues& plane) const {
  const auto& [first, second] = plane.g;
  if (first.value < 0 || second.value < 0) return true;
  const bool is_through_one_end = (first.value == 0) != (second.value == 0);
  return is_through_one_end && !plane.is_closed && setting_.state.line_mode != LineMode::bresenham;
}

ClipPlane PrimitiveDrawing::clip_plane(const PlaneValues& plane, const LineWeights& weights) const {
  std::array<ExactSum, 3> sums;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const ExactSum& along = weights.e[end].coefficients()[i];
      sums[i].add_product(along, plane.g[end].value);
      sums[i].add_product(along, plane.g[end].tail);
    }
  }
  const int x = sums[0].sign();
  const bool owns_zero = x != 0 ? x > 0 : setting_.tie_sign * sums[1].sign() > 0;
  return {ExactPlane(sums[0], sums[1], sums[2]), plane.is_closed || owns_zero};
}

/// True if nothing may cut or drop the primitive, whose vertices are the first `vertices` ones.
bool PrimitiveDrawing::may_be_snapped(const InputTriangle& input, std::size_t vertices,
                                      const std::vector<PlaneValues>& planes) const {
  const State& state = setting_.state;
  if (!state.snapping) return false;
  const Grid grid = grid_of(state);
  for (std::size_t i = 0; i < vertices; ++i) {
    const bool is_inside = is_within_guard_band(grid, input.positions[i]) &&
                           std::all_of(planes.begin(), planes.end(), [i](const PlaneValues& plane) {
                             return plane.g[i].value >= 0;
                           });
    if (!is_inside) return false;
  }
  return true;
}

Fate PrimitiveDrawing::set_up_line(const InputTriangle& input) {
  const State& state = setting_.state;
  const std::vector<PlaneValues> planes = plane_values(input);
  const bool is_hidden = std::any_of(planes.begin(), planes.end(), [](const PlaneValues& plane) {
    return plane.g[0].value < 0 && plane.g[1].value < 0;
  });
  if (is_hidden || (input.positions[0].w <= 0 && input.positions[1].w <= 0)) return Fate::hidden;
  const std::array<WindowColumn, 2> exact{window_column(state, input.positions[0]),
                                          window_column(state, input.positions[1])};
  const bool is_snapped = may_be_snapped(input, 2, planes);
  std::array<WindowColumn, 2> ends = exact;
  if (is_snapped) {
    ends = {snapped_column(state, input.positions[0]), snapped_column(state, input.positions[1])};
  }
  const auto has_length = [](const LineWeights& weights) {
    return weights.direction[0].sign() != 0 || weights.direction[1].sign() != 0;
  };
  const LineWeights shown = line_weights(ends, state.line_mode);
  if (!has_length(shown)) return Fate::degenerate;
  line_.emplace(state, ends, setting_.tie_sign);
  const bool has_snapped_values = is_snapped && state.basis == Basis::snapped;
  const LineWeights weights = has_snapped_values ? shown : line_weights(exact, state.line_mode);
  // Without a length of its own, the line has no values between its ends.
  if (!has_length(weights)) return Fate::degenerate;
  values_.set_line(state, input, weights, has_snapped_values);
  for (const PlaneValues& plane : planes) {
    if (!is_snapped && may_cut(plane)) clips_.push_back(clip_plane(plane, weights));
  }
  box_ = line_->box({setting_.bounds.columns, setting_.bounds.rows});
  return box_.columns.empty() || box_.rows.empty() ? Fate::hidden : Fate::drawn;
}

Fate PrimitiveDrawing::set_up_point(const InputTriangle& input) {
  const State& state = setting_.state;
  const std::vector<PlaneValues> planes = plane_values(input);
  const bool is_dropped = std::any_of(
      planes.begin(), planes.end(), [](const PlaneValues& plane) { return plane.g[0].value < 0; });
  if (is_dropped || input.positions[0].w <= 0) return Fate::hidden;
  const bool is_snapped = may_be_snapped(input, 1, planes);
  point_.emplace(state,
                 is_snapped ? snapped_column(state, input.positions[0])
                            : window_column(state, input.positions[0]),
                 setting_.tie_sign);
  values_.set_point(state, input);
  box_ = point_->box({setting_.bounds.columns, setting_.bounds.rows});
  return box_.columns.empty() || box_.rows.empty() ? Fate::hidden : Fate::drawn;
}

/// Appends what a drawing covers to a list of fragments.
class FragmentList {
 public:
  FragmentList(const DrawSetting& setting, const Mesh& mesh, Fragments& fragments)
      : setting_(setting), mesh_(mesh), fragments_(fragments), masks_(setting.pattern.size()) {
    for (std::size_t a = 0; a < setting.state.attributes.size(); ++a) {
      of_values_[a] = &values_[a];
      along_u_[a] = &slopes_u_[a];
      along_v_[a] = &slopes_v_[a];
    }
  }
  FragmentList(const FragmentList&) = delete;  // it points into itself
  FragmentList& operator=(const FragmentList&) = delete;

  void append(std::uint32_t index, const PixelBox& box, FallbackDrawing& drawing) {
    const glm::uvec3& corners = mesh_.triangles[index];
    vertex_ = corners[static_cast<glm::length_t>(provoking_vertex(setting_.state))];
    for (int y = box.rows.begin; y < box.rows.end; ++y) {
      const int begin = box.columns.begin - box.columns.begin % kBlockSize;
      for (int first = begin; first < box.columns.end; first += kBlockSize) {
        Mask touched = 0;
        for (std::size_t s = 0; s < masks_.size(); ++s) {
          masks_[s] = drawing.cover(s, y, first);
          touched |= masks_[s];
        }
        for_each_bit(touched, [&](int column) {
          for (std::size_t s = 0; s < masks_.size(); ++s) {
            if ((masks_[s] >> column & 1) == 0) continue;
            put(index, {s, first + column, y}, drawing);
          }
        });
      }
    }
  }

 private:
  void put(std::uint32_t index, const LanePlace& place, FallbackDrawing& drawing) {
    const std::size_t count = setting_.state.attributes.size();
    const auto wanted = [&](std::span<double* const> all) {
      return setting_.state.derivatives ? all.first(count) : std::span<double* const>();
    };
    float depth = 0;
    drawing.evaluate(place, {&depth, of_values_, wanted(along_u_), wanted(along_v_), 0});
    fragments_.triangle.push_back(index);
    fragments_.x.push_back(static_cast<std::uint16_t>(place.x));
    fragments_.y.push_back(static_cast<std::uint16_t>(place.y));
    fragments_.sample.push_back(static_cast<std::uint8_t>(place.sample));
    fragments_.depth.push_back(depth);
    for (std::size_t a = 0; a < count; ++a) {
      // Conversions to double and back would change the bits of some NaNs.
      const bool is_flat = setting_.state.attributes[a].interpolation == Interpolation::flat;
      fragments_.attributes.push_back(is_flat ? mesh_.attributes[vertex_ * count + a]
                                              : static_cast<float>(values_[a]));
      if (!setting_.state.derivatives) continue;
      fragments_.derivatives.push_back(static_cast<float>(slopes_u_[a]));
      fragments_.derivatives.push_back(static_cast<float>(slopes_v_[a]));
    }
  }

  const DrawSetting& setting_;
  const Mesh& mesh_;
  Fragments& fragments_;
  std::vector<Mask> masks_;  ///< [sample], of the current block
  std::size_t vertex_ = 0;   ///< the provoking one
  std::array<double, kMaxAttributes> values_{};
  std::array<double, kMaxAttributes> slopes_u_{};
  std::array<double, kMaxAttributes> slopes_v_{};
  std::array<double*, kMaxAttributes> of_values_{};
  std::array<double*, kMaxAttributes> along_u_{};
  std::array<double*, kMaxAttributes> along_v_{};
};

}  // namespace

std::unique_ptr<FallbackDrawing> make_primitive_drawing(const DrawSetting& setting,
                                                        const Mesh& mesh) {
  return std::make_unique<PrimitiveDrawing>(setting, mesh);
}

DrawCounts draw_primitives(const State& state, const Mesh& mesh, const TargetSize& size,
                           Fragments& fragments) {
  const DrawSetting setting(state, size);
  PrimitiveDrawing drawing(setting, mesh);
  FragmentList list(setting, mesh, fragments);
  DrawCounts counts;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    PixelBox box;
    const Fate fate = drawing.locate(static_cast<std::uint32_t>(i), box);
    count(fate, counts);
    if (fate == Fate::drawn) list.append(static_cast<std::uint32_t>(i), box, drawing);
  }
  return counts;
}

}  // namespace rastercheck::rasterizer
