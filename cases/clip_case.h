#pragma once

#include <cassert>
#include <memory>
#include <utility>

#include "cases/case.h"

namespace rastercheck::cases {

/// A case as it is drawn: its positions are clip coordinates, and it has no camera. Later changes
/// of it do not reach given().
class ClipCase : public Case {
 public:
  /// A case without a camera, as it stands.
  explicit ClipCase(Case c) : Case(std::move(c)) { assert(!camera); }
  /// A case without a camera that was made from one with a camera (oracle/transform.h).
  ClipCase(Case clip, const Case& given)
      : Case(std::move(clip)), given_(std::make_shared<const Case>(given)) {
    assert(!camera);
  }

  /// The case with its camera, where there was one; else this.
  const Case& given() const { return given_ ? *given_ : *this; }

 private:
  std::shared_ptr<const Case> given_;
};

}  // namespace rastercheck::cases
