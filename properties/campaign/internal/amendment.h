#pragma once

#include <utility>

#include "backends/backend.h"

namespace rastercheck::properties {

/// Adds an amendment to a backend's drawings for this object's lifetime, applied after existing
/// amendments.
class MoreAmended {
 public:
  MoreAmended(backends::Backend& backend, backends::Backend::Amendment more)
      : backend_(&backend), before_(backend.amendment()) {
    backend.amend_by(
        [before = before_, more = std::move(more)](const cases::Case& c, cases::Fragments& drawn) {
          if (before) before(c, drawn);
          more(c, drawn);
        });
  }
  MoreAmended(const MoreAmended&) = delete;
  MoreAmended& operator=(const MoreAmended&) = delete;
  ~MoreAmended() { backend_->amend_by(std::move(before_)); }

 private:
  backends::Backend* backend_;
  backends::Backend::Amendment before_;
};

}  // namespace rastercheck::properties
