#pragma once

#include <optional>

#include "oracle/rational.h"
#include "records/enclosure.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// A computed number f compared with the exact one. An infinite f counts as ±2^128.
struct JudgedNumber {
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  Rational exact;
  /// (f − exact) / ulp(f), and the largest error allowed in that unit; empty if f is infinite or
  /// NaN.
  std::optional<records::Enclosure> error;
  std::optional<records::Enclosure> bound;
  /// True if the exact value nearly cancelled: `allowed` of judge_number() exceeds half an ulp of
  /// f.
  bool is_cancelled = false;
};

/// Judges f, which may differ from `exact` by `allowed` (>= 0) plus half an ulp of f.
JudgedNumber judge_number(const Rational& exact, const Rational& allowed, float f);

}  // namespace rastercheck::oracle
