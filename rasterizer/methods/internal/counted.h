#pragma once

// A double that counts its arithmetic operations, so that a method's cost is measured on its code.

#include <cstddef>

#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {

class Counted {
 public:
  Counted() = default;
  explicit Counted(double value) : value_(value) {}
  explicit operator double() const { return value_; }
  explicit operator float() const { return static_cast<float>(value_); }

  friend Counted operator+(Counted a, Counted b) {
    ++tally().additions;
    return Counted(a.value_ + b.value_);
  }
  friend Counted operator-(Counted a, Counted b) {
    ++tally().additions;
    return Counted(a.value_ - b.value_);
  }
  friend Counted operator*(Counted a, Counted b) {
    ++tally().multiplications;
    return Counted(a.value_ * b.value_);
  }
  friend Counted operator/(Counted a, Counted b) {
    ++tally().divisions;
    return Counted(a.value_ / b.value_);
  }
  friend Counted operator-(Counted a) { return Counted(-a.value_); }
  Counted& operator+=(Counted other) { return *this = *this + other; }
  friend bool operator<(Counted a, Counted b) { return a.value_ < b.value_; }
  friend bool operator>(Counted a, Counted b) { return a.value_ > b.value_; }
  friend bool operator==(Counted a, Counted b) { return a.value_ == b.value_; }

  /// The operations counted so far on this thread.
  static Operations& tally() {
    static thread_local Operations operations;
    return operations;
  }

 private:
  double value_ = 0;
};

/// Counts the operations of `work`.
template <class Work>
Operations count_operations(const Work& work) {
  Operations& tally = Counted::tally();
  tally = {};
  work();
  const Operations counted = tally;
  tally = {};
  return counted;
}

}  // namespace rastercheck::rasterizer
