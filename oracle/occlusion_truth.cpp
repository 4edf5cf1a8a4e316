#include "oracle/occlusion_truth.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "oracle/internal/compared_depth.h"
#include "oracle/internal/floating_point.h"
#include "oracle/internal/nearest.h"
#include "oracle/internal/next_double.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/triangle_boxes.h"

namespace rastercheck::oracle {
namespace {

using records::Enclosure;
using records::Verdict;

constexpr double kBehindAll = std::numeric_limits<double>::infinity();
constexpr double kAnyDepth = std::numeric_limits<double>::quiet_NaN();

/// The depths that a backend may compare; empty if any is right.
using Depths = std::optional<FieldRange>;

bool is_surely_before(const Depths& a, const Depths& b) { return a && b && a->hi < b->lo; }
/// Equal depths are not seen, unless the contract keeps the last of them.
bool is_surely_not_before(const Depths& a, const Depths& b, const SceneTruth& scene) {
  const bool sees_equals = scene.contract().keeps_last_of_equals();
  return a && b && (sees_equals ? a->lo > b->hi : a->lo >= b->hi);
}

/// The initial values that the depth buffer may have (initial_depths()).
struct InitialDepth {
  explicit InitialDepth(const SceneTruth& scene) {
    const Enclosure clear = initial_depths(scene);
    least = Field(clear.lo);
    // If the case does not name the value, it may lie beyond all depths.
    if (scene.source().depth_clear) greatest = Field(clear.hi);
    near = {enclose(least).lo, greatest ? enclose(*greatest).hi : kBehindAll};
  }

  Depths greatest_depths() const {
    return greatest ? Depths(FieldRange{*greatest, *greatest}) : std::nullopt;
  }

  Field least;
  std::optional<Field> greatest;
  Enclosure near;
};

/// A sample of the occludee.
struct SeenSample {
  int x = 0;
  int y = 0;
  int sample = 0;
  bool is_required = false;  ///< visible under every reading of the triangles looked at so far
  bool is_hidden = false;    ///< hidden under every reading
  Enclosure depth;           ///< NaN if any depth is right
  std::optional<Depths> exact = std::nullopt;  ///< computed when first needed
};

}  // namespace

/// Decides the samples of one triangle of the occludee in a band of rows.
class OcclusionTruth::Band {
 public:
  Band(const OcclusionTruth& truth, PreparedTriangles& triangles, std::uint32_t occludee, int y0,
       int y1, records::LevelCounts& levels)
      : truth_(&truth),
        initial_(*truth.scene_),
        triangles_(&triangles),
        // A copy, because the cache may drop it.
        occludee_(triangles.of(occludee)),
        y0_(y0),
        y1_(y1),
        levels_(&levels) {
    const PixelBox& box = occludee_.filter->box();
    y0_ = std::max(y0_, box.y0);
    y1_ = std::min(y1_, box.y1);
    if (occludee_.filter->is_empty() || y0_ >= y1_) return;
    const cases::FramebufferSize& size = truth.scene_->source().framebuffer;
    places_.assign(static_cast<std::size_t>(y1_ - y0_) * static_cast<std::size_t>(size.width) *
                       static_cast<std::size_t>(size.samples),
                   kNone);
    add_samples();
  }

  bool is_empty() const { return samples_.empty(); }

  /// Lets an occluder hide what it hides.
  void add(std::uint32_t occluder) {
    const PreparedTriangles::Prepared& prepared = triangles_->of(occluder);
    if (prepared.filter->is_empty()) return;
    const DepthSlack<double> slack = slack_of(prepared, ComparedAs::drawn);
    const PixelBox& box = prepared.filter->box();
    for (int y = std::max(y0_, box.y0); y < std::min(y1_, box.y1); ++y) {
      row_.classify(*prepared.truth, *prepared.filter, y, *levels_);
      row_.for_each_covered([&](int x, int s, const records::SampleVerdict& decision) {
        const std::size_t place = place_of(x, y, s);
        if (places_[place] == kNone) return;
        SeenSample& seen = samples_[places_[place]];
        if (seen.is_hidden) return;
        hide(seen, prepared, decision.verdict == Verdict::required, slack);
      });
    }
  }

  void let_out(std::uint32_t occludee, const Take& take) const {
    for (const SeenSample& seen : samples_) {
      const bool is_required = seen.is_required && !truth_->has_unpromised_occluder_;
      take({occludee, static_cast<std::uint32_t>(seen.y), static_cast<std::uint32_t>(seen.x),
            static_cast<std::uint32_t>(seen.sample)},
           seen.is_hidden ? Verdict::forbidden
           : is_required  ? Verdict::required
                          : Verdict::permitted);
    }
  }

 private:
  using Prepared = PreparedTriangles::Prepared;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::size_t place_of(int x, int y, int s) const {
    const cases::FramebufferSize& size = truth_->scene_->source().framebuffer;
    return (static_cast<std::size_t>(y - y0_) * static_cast<std::size_t>(size.width) +
            static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(size.samples) +
           static_cast<std::size_t>(s);
  }

  static DepthSlack<double> slack_of(const Prepared& prepared, ComparedAs as) {
    if (prepared.truth->is_value_free(std::nullopt)) return {kAnyDepth, kAnyDepth};
    return near_depth_slack(prepared.truth->setup(), as);
  }

  Enclosure depth_of(const Prepared& prepared, const DepthSlack<double>& slack, int x, int y,
                     int s) const {
    const auto pattern = truth_->scene_->scene().pattern();
    std::optional<Enclosure> depth =
        prepared.depths().at(x, y, pattern[static_cast<std::size_t>(s)]);
    if (!depth) {
      const std::optional<ValueRange> exact = prepared.truth->depth(x, y, s);
      if (!exact) return {kAnyDepth, kAnyDepth};
      depth = {exact->lo.enclosure().lo, exact->hi.enclosure().hi};
    }
    return widened_depths(*truth_->scene_, *depth, slack);
  }

  /// Finds the samples of the occludee, and compares them with the buffer's initial value.
  void add_samples() {
    const DepthSlack<double> slack = slack_of(occludee_, ComparedAs::occludee);
    for (int y = y0_; y < y1_; ++y) {
      row_.classify(*occludee_.truth, *occludee_.filter, y, *levels_);
      row_.for_each_covered([&](int x, int s, const records::SampleVerdict& decision) {
        SeenSample seen{x,     y,
                        s,     decision.verdict == Verdict::required,
                        false, depth_of(occludee_, slack, x, y, s)};
        // NaN fails these comparisons.
        if (seen.depth.lo > initial_.near.hi) {
          seen.is_hidden = true;
        } else if (!(seen.depth.hi < initial_.near.lo)) {
          const Depths& depths = exact_depths(seen);
          seen.is_hidden = is_surely_not_before(depths, initial_.greatest_depths(), scene());
          seen.is_required = seen.is_required && depths && depths->hi < initial_.least;
        }
        places_[place_of(x, y, s)] = static_cast<std::uint32_t>(samples_.size());
        samples_.push_back(seen);
      });
    }
  }

  const Depths& exact_depths(SeenSample& seen) const {
    if (!seen.exact) {
      seen.exact.emplace(
          compared_depths(*occludee_.truth, seen.x, seen.y, seen.sample, ComparedAs::occludee));
    }
    return *seen.exact;
  }

  const SceneTruth& scene() const { return *truth_->scene_; }

  void hide(SeenSample& seen, const Prepared& occluder, bool must_cover,
            const DepthSlack<double>& slack) {
    const Enclosure depth = depth_of(occluder, slack, seen.x, seen.y, seen.sample);
    // NaN fails these comparisons.
    if (seen.depth.hi < depth.lo) return;
    if (seen.depth.lo > depth.hi) {
      seen.is_hidden = must_cover;
      seen.is_required = false;
      return;
    }
    const Depths exact = compared_depths(*occluder.truth, seen.x, seen.y, seen.sample);
    const Depths& own = exact_depths(seen);
    seen.is_required = seen.is_required && is_surely_before(own, exact);
    seen.is_hidden = must_cover && is_surely_not_before(own, exact, scene());
  }

  const OcclusionTruth* truth_;
  InitialDepth initial_;
  PreparedTriangles* triangles_;
  Prepared occludee_;
  int y0_;
  int y1_;
  records::LevelCounts* levels_;
  std::vector<SeenSample> samples_;
  std::vector<std::uint32_t> places_;  ///< [row][x][sample]: index into samples_
  CoverageRow row_;
};

OcclusionTruth::OcclusionTruth(const SceneTruth& scene, std::size_t occluders, Level first)
    : scene_(&scene), occluders_(occluders), first_level_(first) {
  const DefaultFloatingPoint floating_point;
  assert(occluders <= scene.source().triangles.size());
  boxes_ = boxes_of_triangles(scene);
  for (std::size_t t = 0; t < occluders; ++t) {
    const bool is_made = cases::promise_of(scene.contract(), scene.source(), t).is_made;
    has_unpromised_occluder_ = has_unpromised_occluder_ || !is_made;
  }
}

void OcclusionTruth::for_each_sample(const Take& take, records::LevelCounts& levels) const {
  const DefaultFloatingPoint floating_point;
  PreparedTriangles triangles(*scene_, first_level_);
  const cases::FramebufferSize& size = scene_->source().framebuffer;
  const int rows = rows_of_band(size);
  const auto is_disjoint = [](const PixelBox& a, const PixelBox& b) {
    return a.x0 >= b.x1 || b.x0 >= a.x1 || a.y0 >= b.y1 || b.y0 >= a.y1;
  };
  for (auto occludee = static_cast<std::uint32_t>(occluders_); occludee < boxes_.size();
       ++occludee) {
    const PixelBox& box = boxes_[occludee];
    if (box.x0 >= box.x1) continue;
    for (int y0 = box.y0; y0 < box.y1; y0 += rows) {
      const int y1 = std::min(y0 + rows, box.y1);
      Band band(*this, triangles, occludee, y0, y1, levels);
      if (band.is_empty()) continue;
      const PixelBox part{box.x0, y0, box.x1, y1};
      for (std::uint32_t occluder = 0; occluder < occluders_; ++occluder) {
        if (!is_disjoint(boxes_[occluder], part)) band.add(occluder);
      }
      band.let_out(occludee, take);
    }
  }
}

Verdict OcclusionTruth::judge(const cases::SamplePlace& place) const {
  const DefaultFloatingPoint floating_point;
  const auto x = static_cast<int>(place.x);
  const auto y = static_cast<int>(place.y);
  const auto s = static_cast<int>(place.sample);
  const TriangleTruth occludee(*scene_, place.triangle);
  const Verdict covers = occludee.judge(x, y, s).verdict;
  if (covers == Verdict::forbidden) return Verdict::forbidden;
  const Depths depths = compared_depths(occludee, x, y, s, ComparedAs::occludee);
  const InitialDepth initial(*scene_);
  if (is_surely_not_before(depths, initial.greatest_depths(), *scene_)) return Verdict::forbidden;
  bool is_required = covers == Verdict::required && !has_unpromised_occluder_ && depths &&
                     depths->hi < initial.least;
  for (std::size_t t = 0; t < occluders_; ++t) {
    const TriangleTruth occluder(*scene_, t);
    if (!occluder.setup().promise.is_made) continue;
    const Verdict verdict = occluder.judge(x, y, s).verdict;
    if (verdict == Verdict::forbidden) continue;
    const Depths hiding = compared_depths(occluder, x, y, s);
    if (verdict == Verdict::required && is_surely_not_before(depths, hiding, *scene_)) {
      return Verdict::forbidden;
    }
    is_required = is_required && is_surely_before(depths, hiding);
  }
  return is_required ? Verdict::required : Verdict::permitted;
}

OcclusionDepths OcclusionTruth::depths(const cases::SamplePlace& place) const {
  const DefaultFloatingPoint floating_point;
  const auto x = static_cast<int>(place.x);
  const auto y = static_cast<int>(place.y);
  const auto s = static_cast<int>(place.sample);
  const Depths occludee =
      compared_depths(TriangleTruth(*scene_, place.triangle), x, y, s, ComparedAs::occludee);
  assert(occludee);
  Field least = InitialDepth(*scene_).least;
  std::optional<std::uint32_t> nearest;
  for (std::uint32_t t = 0; t < occluders_; ++t) {
    const TriangleTruth occluder(*scene_, t);
    if (occluder.judge(x, y, s).verdict == Verdict::forbidden) continue;
    const Depths hiding = compared_depths(occluder, x, y, s);
    assert(hiding);
    if (!(hiding->lo < least)) continue;
    least = hiding->lo;
    nearest = t;
  }
  if (scene_->contract().is_depth_reversed()) {
    return {to_rational(-occludee->hi), to_rational(-least), nearest};
  }
  return {to_rational(occludee->hi), to_rational(std::move(least)), nearest};
}

}  // namespace rastercheck::oracle
