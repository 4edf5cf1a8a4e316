#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "oracle/rational.h"
#include "records/enclosure.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// The clip case of a camera case: positions become projection · view · model · position, computed
/// exactly and rounded once to float32 (nearest, ties to even, subnormals kept), and the camera is
/// gone. A case without a camera stays as it is. Fails where a clip position overflows float32, at
/// that vertex; `file` is the name for the error.
Result<cases::Case> to_clip_case(const cases::Case& c, const std::string& file);

/// A computed clip coordinate f against the exact one. Infinity stands for 2^128.
struct JudgedCoordinate {
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  Rational exact;
  /// (f − exact) / ulp(f), and how far it may be off in that unit; nothing of an infinity and of
  /// NaN.
  std::optional<records::Enclosure> error;
  std::optional<records::Enclosure> bound;
  /// Whether it is small beside what it is the sum of: half an ulp is less than what the bound
  /// leaves besides.
  bool is_cancelled = false;
};
using JudgedPosition = std::array<JudgedCoordinate, 4>;

/// Judges clip positions, one for each vertex of a case, by Contract::transform_bound, which is not
/// negative. Without a camera the positions themselves are the exact ones.
std::vector<JudgedPosition> judge_transform(const cases::Case& c,
                                            std::span<const cases::ClipVertex> computed,
                                            float transform_bound);

}  // namespace rastercheck::oracle
