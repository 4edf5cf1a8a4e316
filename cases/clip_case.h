#pragma once

#include <cassert>
#include <memory>
#include <utility>

#include "cases/case.h"

namespace rastercheck::cases {

/// A case as it is drawn: its positions are clip coordinates, and it has no camera. If it was made
/// from a case with a camera, given() is that case, whatever changes in this case later; else
/// given() is this case.
class ClipCase : public Case {
 public:
  /// Wraps a case without a camera.
  explicit ClipCase(Case c) : Case(std::move(c)) { assert(!camera); }
  /// Wraps a case without a camera that was made from `given`, a case with one
  /// (oracle/transform.h).
  ClipCase(Case clip, const Case& given)
      : Case(std::move(clip)), given_(std::make_shared<const Case>(given)) {
    assert(!camera);
  }

  /// The original case with its camera, if any; else this case.
  const Case& given() const { return given_ ? *given_ : *this; }

 private:
  std::shared_ptr<const Case> given_;
};

}  // namespace rastercheck::cases
