#pragma once

// What commands share that check a saved case again.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/known_defects.h"
#include "properties/law.h"

namespace rastercheck::cli {

/// Returns the laws to check: the one that found the case, or all.
Result<std::vector<const properties::Law*>> laws_for(const cases::Case& c, const std::string& file);

/// A backend, and its known defects.
struct Drawer {
  std::unique_ptr<backends::Backend> backend;
  std::optional<properties::KnownDefects> known;
};

Result<Drawer> make_drawer(const backends::BackendFactory& factory,
                           const std::string& specification,
                           const properties::KnownSources& known_sources);

/// Checks one law on a case. If the case has the law's `found`, violations like it come first.
properties::Check check_again(const properties::Law& law, const cases::Case& c,
                              const Drawer& drawer);

}  // namespace rastercheck::cli
