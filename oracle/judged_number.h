#pragma once

#include <optional>

#include "oracle/rational.h"
#include "records/enclosure.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// A computed number f against the exact one. Infinity stands for 2^128.
struct JudgedNumber {
  records::FragmentClass fragment_class = records::FragmentClass::correct;
  Rational exact;
  /// (f − exact) / ulp(f), and how far it may be off in that unit; nothing of an infinity and of
  /// NaN.
  std::optional<records::Enclosure> error;
  std::optional<records::Enclosure> bound;
  /// Whether it is small beside what it is the sum of: half an ulp is less than what is allowed
  /// besides.
  bool is_cancelled = false;
};

/// f may be off by `allowed`, which is not negative, and by half an ulp of its own.
JudgedNumber judge_number(const Rational& exact, const Rational& allowed, float f);

}  // namespace rastercheck::oracle
