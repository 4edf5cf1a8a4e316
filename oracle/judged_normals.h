#pragma once

#include <array>
#include <span>
#include <vector>

#include "cases/case.h"
#include "records/enclosure.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// A component of a computed unit normal compared with the exact one, which is irrational in
/// general.
struct JudgedComponent {
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  records::Enclosure exact{0, 0};
};

struct JudgedNormal {
  std::array<JudgedComponent, 3> components;
  bool has_direction = true;  ///< the exact image is not zero
  bool is_mirrored = false;   ///< the model's determinant is negative
  bool is_singular = false;   ///< the model's determinant is 0
  /// True if the image nearly cancelled: the part of the bound that grows with cancellation exceeds
  /// 2^-25, half an ulp just below 1.
  bool is_cancelled = false;
};

/// Judges the computed unit normals, one per object-space normal, by Contract::normal_bound (>= 0).
/// Decides by comparing squares, without a root. If the image of a normal is zero, every computed
/// component must be zero, of either sign.
std::vector<JudgedNormal> judge_normals(const cases::Matrix4& model,
                                        std::span<const cases::Normal> normals,
                                        std::span<const cases::Normal> computed,
                                        float normal_bound);

}  // namespace rastercheck::oracle
