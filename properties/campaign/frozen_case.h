#pragma once

#include <optional>
#include <span>

#include "cases/case.h"
#include "records/case_record.h"
#include "records/plan.h"

namespace rastercheck::properties {

/// Returns a case that every run with the same seed has: corpus or random. Empty for other origins,
/// or if the case no longer exists.
std::optional<cases::Case> frozen_case(const records::CaseKey& key, const records::Plan& plan,
                                       std::span<const cases::Case> corpus);

}  // namespace rastercheck::properties
