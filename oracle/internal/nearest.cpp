#include "oracle/internal/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/internal/compared_depth.h"
#include "oracle/internal/scene.h"

namespace rastercheck::oracle {
namespace {

using records::Enclosure;
using records::Reason;
using records::Verdict;

constexpr double kFarthest = std::numeric_limits<double>::infinity();
constexpr double kNoDepth = std::numeric_limits<double>::quiet_NaN();

bool is_required(const records::SampleVerdict& decision) {
  return decision.verdict == Verdict::required;
}

/// The z/w that all vertices of a triangle share.
struct PlaneDepth {
  Ring z;
  Ring w;

  bool operator==(const PlaneDepth& other) const { return z * other.w == other.z * w; }
};

/// Empty unless the triangle lies in a plane of constant depth, and the contract keeps its depth
/// equal to that of other triangles of the plane. A camera's positions are rounded before they are
/// drawn, and their depths may then differ. With a bias, the unit of float32 may differ, because a
/// vertex with w <= 0 counts as the far end of the depth range.
std::optional<PlaneDepth> kept_plane(const TriangleSetup& triangle) {
  const Scene& scene = *triangle.scene;
  if (!scene.contract().keeps_equal_depth || scene.source().camera) return std::nullopt;
  if (scene.has_depth_bias() && scene.unorm_bits() == 0) return std::nullopt;
  const RingVector4 first = scene.clip_position(triangle.indices[0]);
  PlaneDepth depth{first[2], first[3]};
  for (const std::uint32_t vertex : triangle.indices) {
    const RingVector4 p = scene.clip_position(vertex);
    if (sign_of(p[3]) == 0 || !(PlaneDepth{p[2], p[3]} == depth)) return std::nullopt;
  }
  return depth;
}

}  // namespace

const DepthFilter& PreparedTriangles::Prepared::depths() const {
  if (!depth_filter) depth_filter = std::make_shared<const DepthFilter>(truth->setup(), *filter);
  return *depth_filter;
}

const PreparedTriangles::Prepared& PreparedTriangles::of(std::uint32_t triangle) {
  const auto found = prepared_.find(triangle);
  if (found != prepared_.end()) return found->second;
  if (prepared_.size() == kMost) prepared_.clear();
  auto truth = std::make_shared<const TriangleTruth>(*scene_, triangle);
  auto filter =
      std::make_shared<const TriangleFilter>(truth->setup(), truth->setup().pixels(), first_level_);
  return prepared_[triangle] = {std::move(truth), std::move(filter), nullptr};
}

void PreparedTriangles::forget_rows_before(int y) {
  std::erase_if(prepared_, [y](const auto& entry) { return entry.second.filter->box().y1 <= y; });
}

NearestBand::NearestBand(const SceneTruth& scene, int y0, int y1, PreparedTriangles& triangles,
                         Comparison comparison)
    : scene_(&scene),
      y0_(y0),
      y1_(y1),
      clear_depths_(initial_depths(scene)),
      triangles_(&triangles),
      comparison_(comparison) {
  // If the case does not name the buffer's initial value, it may lie beyond all depths.
  double horizon = kFarthest;
  if (scene.source().depth_clear) {
    horizon = clear_depths_.hi;
    if (!scene.contract().keeps_last_of_equals()) horizon = std::nextafter(horizon, -kFarthest);
  }
  const cases::FramebufferSize& size = scene.source().framebuffer;
  samples_.resize(static_cast<std::size_t>(y1 - y0) * static_cast<std::size_t>(size.width) *
                      static_cast<std::size_t>(size.samples),
                  Sample{{}, false, horizon});
}

Enclosure NearestBand::depth_of(const PreparedTriangles::Prepared& triangle,
                                const DepthFilter& filter, const DepthSlack<double>& slack, int x,
                                int y, int s) const {
  const auto pattern = scene_->scene().pattern();
  std::optional<Enclosure> depth = filter.at(x, y, pattern[static_cast<std::size_t>(s)]);
  if (!depth) {
    const std::optional<ValueRange> exact = triangle.truth->depth(x, y, s);
    if (!exact) return {kNoDepth, kNoDepth};
    depth = {exact->lo.enclosure().lo, exact->hi.enclosure().hi};
  }
  return widened_depths(*scene_, *depth, slack);
}

void NearestBand::add(std::uint32_t triangle, records::LevelCounts& levels) {
  const PreparedTriangles::Prepared& prepared = triangles_->of(triangle);
  if (prepared.filter->is_empty()) return;
  const TriangleSetup& setup = prepared.truth->setup();
  const DepthFilter& depths = prepared.depths();
  const DepthSlack<double> slack = prepared.truth->is_value_free(std::nullopt)
                                       ? DepthSlack<double>{kNoDepth, kNoDepth}
                                       : near_depth_slack(setup);
  const cases::FramebufferSize& size = scene_->source().framebuffer;
  const PixelBox& box = prepared.filter->box();
  for (int y = std::max(y0_, box.y0); y < std::min(y1_, box.y1); ++y) {
    row_.classify(*prepared.truth, *prepared.filter, y, levels);
    Sample* const samples =
        samples_.data() + static_cast<std::ptrdiff_t>(y - y0_) * size.width * size.samples;
    row_.for_each_covered([&](int x, int s, const records::SampleVerdict& decision) {
      add(samples[x * size.samples + s],
          {triangle, decision, depth_of(prepared, depths, slack, x, y, s)});
    });
  }
}

void NearestBand::add(Sample& sample, const Covering& covering) const {
  // NaN fails these comparisons, so a covering without a depth is neither nearer nor behind.
  sample.is_required = sample.is_required ||
                       (is_required(covering.decision) && covering.depth.hi < clear_depths_.lo);
  if (covering.depth.lo > sample.horizon) return;
  sample.coverings.push_back(covering);
  if (!is_required(covering.decision)) return;
  if (!(covering.depth.hi < sample.horizon)) return;
  sample.horizon = covering.depth.hi;
  const auto behind =
      std::remove_if(sample.coverings.begin(), sample.coverings.end(),
                     [&sample](const Covering& other) { return other.depth.lo > sample.horizon; });
  sample.coverings.erase(behind, sample.coverings.end());
}

/// A covering to be compared exactly with others.
struct NearestBand::Rival {
  const Covering* covering = nullptr;
  /// The depths that a backend may compute; empty if any is right.
  std::optional<FieldRange> depth;
  std::optional<PlaneDepth> plane;  ///< kept_plane()

  bool is_surely_nearer_than(double other) const { return depth && depth->hi < Field(other); }
  bool is_surely_nearer_than(const Rival& other) const {
    return depth && other.depth && depth->hi < other.depth->lo;
  }
  /// True if both certainly are one number, as those of a unorm format may be.
  bool has_depth_of(const Rival& other) const {
    return depth && other.depth && depth->lo == depth->hi && other.depth->lo == other.depth->hi &&
           depth->lo == other.depth->lo;
  }
  /// True if the other fails the depth test, or is drawn over, because it has the same depth.
  bool is_equal_and_stays(const Rival& other, bool keeps_last) const {
    const bool is_first = covering->triangle < other.covering->triangle;
    return is_first != keeps_last && ((plane && plane == other.plane) || has_depth_of(other));
  }
  bool surely_hides(const Rival& other, bool keeps_last) const {
    return is_surely_nearer_than(other) || is_equal_and_stays(other, keeps_last);
  }
};

/// Finds the candidates among a sample's coverings. add() has dropped coverings certainly behind a
/// required one or behind the buffer's initial value. That is safe: the nearest required covering
/// is still there, and a covering that beats all others and the initial value also beats the
/// dropped ones.
bool NearestBand::resolve(const Sample& sample, int y, int x, int s,
                          std::vector<Candidate>& candidates) {
  candidates.clear();
  if (sample.coverings.size() == 1 && sample.coverings.front().depth.hi < clear_depths_.lo) {
    const Covering& only = sample.coverings.front();
    candidates.push_back({only.triangle, only.decision});
    return sample.is_required;
  }
  if (comparison_ == Comparison::enclosed) {
    for (const Covering& covering : sample.coverings) {
      candidates.push_back({covering.triangle, {Verdict::permitted, Reason::depth}});
    }
    return sample.is_required;
  }
  bool is_any_required = sample.is_required;
  std::vector<Rival> rivals;
  for (const Covering& covering : sample.coverings) {
    const auto truth = triangles_->of(covering.triangle).truth;
    rivals.push_back({&covering, compared_depths(*truth, x, y, s), kept_plane(truth->setup())});
    // Conservatively covered samples without a depth may have any, in a plane of equal depth, too.
    const bool is_open = !rivals.back().depth && scene_->contract().conservative;
    if (is_open) rivals.back().plane.reset();
  }
  const bool keeps_last = scene_->contract().keeps_last_of_equals();
  for (const Rival& a : rivals) {
    const bool is_drawn = a.is_surely_nearer_than(clear_depths_.lo);
    if (scene_->source().depth_clear && a.depth) {
      const Field clear(clear_depths_.hi);
      const bool is_beyond = keeps_last ? a.depth->lo > clear : a.depth->lo >= clear;
      if (is_beyond) continue;
    }
    is_any_required = is_any_required || (is_drawn && is_required(a.covering->decision));
    const bool is_beaten = std::any_of(rivals.begin(), rivals.end(), [&](const Rival& b) {
      return &b != &a && is_required(b.covering->decision) && b.surely_hides(a, keeps_last);
    });
    if (is_beaten) continue;
    const bool beats_all = std::all_of(rivals.begin(), rivals.end(), [&](const Rival& b) {
      return &b == &a || a.surely_hides(b, keeps_last);
    });
    candidates.push_back({a.covering->triangle, a.covering->decision});
    if (!(is_drawn && beats_all) && is_required(a.covering->decision)) {
      candidates.back().decision = {Verdict::permitted, Reason::depth};
    }
  }
  return is_any_required;
}

void NearestBand::for_each_answer(const Take& take) {
  const cases::FramebufferSize& size = scene_->source().framebuffer;
  std::vector<Candidate> candidates;
  auto sample = samples_.begin();
  for (int y = y0_; y < y1_; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (int s = 0; s < size.samples; ++s, ++sample) {
        if (sample->coverings.empty()) continue;
        const bool is_required_there = resolve(*sample, y, x, s, candidates);
        if (!candidates.empty()) take(y, x, s, candidates, is_required_there);
      }
    }
  }
}

}  // namespace rastercheck::oracle
