#pragma once

// The samples at which an occludee is seen past its occluders, exactly (RULES §11). The judge of
// occlusion cullers: a culler that calls an occludee occluded is wrong iff some sample of it must
// be visible.
//
//   z(q) = the least depth of the occluders that cover sample q, or the depth buffer's initial
//          value if that is less or no occluder covers q
//
// A fragment of the occludee at q is visible iff its depth is less than z(q) (depth test `less`).
// The contract may leave open whether a triangle covers q, and at which depth. So a sample is
//
//   required   visible under every permitted reading: the occludee must cover q, and its greatest
//              permitted depth is less than the least z(q) of any reading, for which every occluder
//              that may cover q counts, at the near end of its range
//   forbidden  visible under none: the occludee may not cover q; or some occluder must cover q and
//              its greatest permitted depth is no greater than the occludee's least; or that is
//              true of the buffer's initial value
//   permitted  otherwise
//
// Ranges of depths are those of depth tests (oracle/judge.h): the exact depths of all permitted
// placements, widened by the contract's depth bound and by a step of the depth buffer's format. A
// contract whose depths are never nearer than the exact ones means the occluders'; those of the
// occludee are then never farther. With another depth function (cases::KeptDepth), "less" above
// stands for what it keeps.
// Readings are not combined: readings of two triangles that exclude each other count together. So
// some visible samples are only `permitted`, but no sample is `required` wrongly.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cases/sample_place.h"
#include "oracle/level.h"
#include "oracle/pixel_box.h"
#include "oracle/rational.h"
#include "oracle/triangle_truth.h"
#include "records/judgement.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// The depths that decide a `required` sample.
struct OcclusionDepths {
  Rational occludee;   ///< the greatest that the contract permits for the occludee's fragment
  Rational occluders;  ///< the least z(q) of any permitted reading
  /// The occluder with that depth; empty if it is the depth buffer's initial value.
  std::optional<std::uint32_t> nearest;
};

class OcclusionTruth {
 public:
  /// The case's triangles before index `occluders` are the occluders, and the others the occludee.
  /// Depths are compared whether or not the case has a depth test. The scene must outlive the
  /// object. `first` is the first level of the cascade that decides coverage.
  OcclusionTruth(const SceneTruth& scene, std::size_t occluders, Level first = Level::filter);

  /// Receives a sample that some triangle of the occludee, `place.triangle`, must or may cover.
  using Take = std::function<void(const cases::SamplePlace& place, records::Verdict is_visible)>;

  /// Calls take for each such sample of each of the occludee's triangles about which the contract
  /// promises something. `levels` counts how the samples of all triangles were decided.
  void for_each_sample(const Take& take, records::LevelCounts& levels) const;

  /// The verdict for one sample of a triangle of the occludee, by exact numbers alone.
  records::Verdict judge(const cases::SamplePlace& place) const;

  /// The depths at a sample that is `required`.
  OcclusionDepths depths(const cases::SamplePlace& place) const;

  /// True if the contract promises nothing about some occluder. It may be drawn anywhere, so no
  /// sample is `required`.
  bool has_unpromised_occluder() const { return has_unpromised_occluder_; }

 private:
  class Band;

  const SceneTruth* scene_;
  std::size_t occluders_;
  Level first_level_;
  bool has_unpromised_occluder_ = false;
  std::vector<PixelBox> boxes_;  ///< [triangle]
};

}  // namespace rastercheck::oracle
