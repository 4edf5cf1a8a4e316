#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "oracle/judged_number.h"
#include "records/enclosure.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// The clip case of a camera case: positions become projection · view · model · position, computed
/// exactly and rounded once to float32 (nearest, ties to even, subnormals kept), and the camera is
/// gone. A case without a camera stays as it is. Fails where a clip position overflows float32, at
/// that vertex; `file` is the name for the error.
Result<cases::Case> to_clip_case(const cases::Case& c, const std::string& file);

/// Of a clip position, x to w.
using JudgedPosition = std::array<JudgedNumber, 4>;

/// Judges clip positions, one for each vertex of a case, by Contract::transform_bound, which is not
/// negative. Without a camera the positions themselves are the exact ones.
std::vector<JudgedPosition> judge_transform(const cases::Case& c,
                                            std::span<const cases::ClipVertex> computed,
                                            float transform_bound);

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
/// not negative: decided by squares, without a root.
std::vector<JudgedNormal> judge_normals(const cases::Matrix4& model,
                                        std::span<const cases::Normal> normals,
                                        std::span<const cases::Normal> computed,
                                        float normal_bound);

}  // namespace rastercheck::oracle
