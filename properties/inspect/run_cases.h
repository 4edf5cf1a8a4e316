#pragma once

// The cases of a run, made again, and the backends that draw them: what looking closely at a run
// has in common, whatever of it is looked at.

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
#include "properties/campaign/known_defects.h"
#include "properties/inspect/focus.h"
#include "properties/inspect/inspect.h"
#include "records/case_record.h"
#include "records/inspection.h"
#include "records/plan.h"

namespace rastercheck::properties {

/// Where a run's cases come from, those aside that its seed gives.
struct CaseSources {
  std::span<const cases::Case> corpus = {};
  std::span<const cases::Case> saved = {};  ///< counterexamples of earlier runs
  KnownByBackend known = {};
  const cases::Case* scene = nullptr;  ///< without a camera; nullptr: none
};

/// A case that every run of the same seed has: of the corpus, or random. Nothing of other origins,
/// and where there is none any more.
std::optional<cases::Case> frozen_case(const records::CaseKey& key, const records::Plan& plan,
                                       std::span<const cases::Case> corpus);

/// Backends, made when first asked for.
class MadeBackends {
 public:
  explicit MadeBackends(backends::BackendFactory factory) : factory_(std::move(factory)) {}

  /// nullptr where there is none any more.
  backends::Backend* find(const std::string& specification);

 private:
  backends::BackendFactory factory_;
  std::map<std::string, std::unique_ptr<backends::Backend>> made_;
};

/// A triangle of a case, in a case that holds it and is no larger than looking at it needs.
struct CasePart {
  cases::Case source;
  std::uint32_t triangle = 0;  ///< index into the triangles of `source`
};

/// The case, or of a large one the triangle alone; nothing where it has no such triangle.
std::optional<CasePart> part_of(cases::Case c, std::uint32_t triangle);

/// Inspects such a part. Nothing where it cannot be drawn, or has no such sample or value.
std::optional<records::Inspection> inspect_part(cases::Case c, const std::string& specification,
                                                Focus focus, MadeBackends& made,
                                                const InspectOptions& options);

/// Whether the sample looked for has this value, to the bit.
bool shows(const records::Inspection& inspection, std::optional<std::uint32_t> attribute,
           float actual);

}  // namespace rastercheck::properties
