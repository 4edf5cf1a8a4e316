#pragma once

// The state of a search for a smaller case, and the passes that it is handed to.

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

  /// The least case so far.
  const cases::Case& current() const { return shrunk_.source; }
  const Check& check() const { return shrunk_.check; }

  /// Takes the candidate as the current case if it is smaller and fails alike. What was offered
  /// before is not checked again.
  bool offer(cases::Case candidate);

  /// The same of the current case, changed.
  template <typename Change>
  bool offer_changed(const Change& change) {
    cases::Case candidate = current();
    change(candidate);
    return offer(std::move(candidate));
  }

  /// Whether the limits allow no more.
  bool is_over() const;
  Shrunk take() { return std::move(shrunk_); }

 private:
  Shrunk shrunk_;
  CaseSize size_;
  const FailsAlike* fails_alike_;
  const ShrinkLimits* limits_;
  std::unordered_set<std::string> refused_;  ///< case files
};

// The passes, each a way of making a case smaller (shrink.h).
void drop_triangles(ShrinkSearch& search);
void simplify_state(ShrinkSearch& search);
void drop_camera(ShrinkSearch& search);
void set_w_to_one(ShrinkSearch& search);
void move_to_grid(ShrinkSearch& search);
void drop_bits(ShrinkSearch& search);
void lessen_exponents(ShrinkSearch& search);
void shrink_viewport(ShrinkSearch& search);

}  // namespace rastercheck::properties
