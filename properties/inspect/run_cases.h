#pragma once

// Makes a run's cases and backends again, for everything that inspects a run.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case.h"
#include "properties/campaign/frozen_case.h"
#include "properties/campaign/known_defects.h"
#include "properties/inspect/focus.h"
#include "properties/inspect/inspect.h"
#include "records/case_record.h"
#include "records/inspection.h"
#include "records/plan.h"

namespace rastercheck::properties {

/// The sources of a run's cases, other than its seed.
struct CaseSources {
  std::span<const cases::Case> corpus = {};
  std::span<const cases::Case> saved = {};  ///< counterexamples of earlier runs
  KnownByBackend known = {};
  const cases::Case* scene = nullptr;  ///< without a camera; nullptr: none
};

/// Backends, made on first use.
class MadeBackends {
 public:
  explicit MadeBackends(backends::BackendFactory factory) : factory_(std::move(factory)) {}

  /// nullptr if the backend can no longer be made or is lost.
  backends::Backend* find(const std::string& specification);

 private:
  backends::BackendFactory factory_;
  std::map<std::string, std::unique_ptr<backends::Backend>> made_;
};

/// A triangle within a case no larger than its inspection needs.
struct CasePart {
  cases::Case source;
  std::uint32_t triangle = 0;  ///< index into the triangles of `source`
};

/// Returns the case, or the triangle alone if the case is large; empty if the triangle does not
/// exist.
std::optional<CasePart> part_of(cases::Case c, std::uint32_t triangle);

/// Inspects a part. Empty if it cannot be drawn or has no such sample or value.
std::optional<records::Inspection> inspect_part(cases::Case c, const std::string& specification,
                                                Focus focus, MadeBackends& made,
                                                const InspectOptions& options);

/// True if the sample in focus has exactly this value.
bool shows(const records::Inspection& inspection, std::optional<std::uint32_t> attribute,
           float actual);

}  // namespace rastercheck::properties
