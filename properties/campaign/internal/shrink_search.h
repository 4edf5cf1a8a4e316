#pragma once

// The state of a search for a smaller case, and the passes that work on it.

#include <cstdint>
#include <string>
#include <unordered_set>

#include "properties/campaign/internal/case_size.h"
#include "properties/campaign/shrink.h"

namespace rastercheck::properties {

class ShrinkSearch {
 public:
  ShrinkSearch(cases::Case failing, Check check, const FailsAlike& fails_alike,
               const ShrinkLimits& limits);

  /// The smallest case so far.
  const cases::Case& current() const { return shrunk_.source; }
  const Check& check() const { return shrunk_.check; }

  /// Makes the candidate the current case if it is smaller and fails alike. Does not check a
  /// candidate twice.
  bool offer(cases::Case candidate);

  /// Tries a changed copy of the current case.
  template <typename Change>
  bool offer_changed(const Change& change) {
    cases::Case candidate = current();
    change(candidate);
    return offer(std::move(candidate));
  }

  /// True if the limits are reached.
  bool is_over() const;
  Shrunk take() { return std::move(shrunk_); }

 private:
  Shrunk shrunk_;
  CaseSize size_;
  const FailsAlike* fails_alike_;
  const ShrinkLimits* limits_;
  std::unordered_set<std::string> refused_;  ///< as case files
};

// The passes, each a way to make a case smaller (shrink.h).
void drop_triangles(ShrinkSearch& search);
void simplify_state(ShrinkSearch& search);
void drop_camera(ShrinkSearch& search);
void set_w_to_one(ShrinkSearch& search);
void move_to_grid(ShrinkSearch& search);
void drop_bits(ShrinkSearch& search);
void lessen_exponents(ShrinkSearch& search);
void shrink_viewport(ShrinkSearch& search);

}  // namespace rastercheck::properties
