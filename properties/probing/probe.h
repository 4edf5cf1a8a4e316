#pragma once

// Measures how a backend draws, using only drawings: cases whose pictures distinguish one way of
// drawing from another. docs/probing.md explains the results; each measure's file explains its
// pictures.

#include <cstdint>
#include <optional>
#include <string>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/campaign_run.h"
#include "records/probe.h"

namespace rastercheck::properties {

/// Settings that all cases of a probe ask for. For each setting left empty, the probe finds out
/// whether the backend honours the case's request.
struct AskedDrawing {
  std::optional<cases::Coverage> coverage;
  std::optional<cases::Basis> basis;
  std::optional<cases::TieRule> fill_rule;
};

struct ProbeOptions {
  std::uint64_t seed = 1;
  int cases = 20;  ///< random cases of each generator, at least 1
  AskedDrawing asked;
};

/// Measures the backend; `name` is its specification. Fails if the backend draws nothing at all or
/// is lost on the way (Backend::is_lost).
Result<records::Probe> probe(const std::string& name, backends::Backend& backend,
                             const ProbeOptions& options, const Progress& progress);

}  // namespace rastercheck::properties
