#pragma once

#include <array>
#include <span>
#include <vector>

#include "cases/case.h"
#include "records/enclosure.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// A component of a computed unit normal against the exact one, a root in general.
struct JudgedComponent {
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  records::Enclosure exact{0, 0};
};

struct JudgedNormal {
  std::array<JudgedComponent, 3> components;
  bool has_direction = true;  ///< its image is not zero
  bool is_mirrored = false;   ///< the model's determinant is negative
  bool is_singular = false;   ///< it is 0
  /// Whether the image is small beside what it is the sum of: half an ulp of 1 is less than what
  /// the bound leaves besides.
  bool is_cancelled = false;
};

/// Judges unit normals, one for each normal in object space, by Contract::normal_bound, which is
/// not negative: decided by squares, without a root. A normal whose image is zero has to come out
/// as zeros of either sign.
std::vector<JudgedNormal> judge_normals(const cases::Matrix4& model,
                                        std::span<const cases::Normal> normals,
                                        std::span<const cases::Normal> computed,
                                        float normal_bound);

}  // namespace rastercheck::oracle
