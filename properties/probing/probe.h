#pragma once

// What a backend does, measured instead of believed: cases are drawn whose pictures tell one way of
// drawing from another, and nothing else is asked of it. docs/probing.md is for those who read the
// results; each measure's file says which picture tells what.

#include <cstdint>
#include <optional>
#include <string>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/campaign_run.h"
#include "records/probe.h"

namespace rastercheck::properties {

/// What all cases of a probe ask for. Of what nothing is said it is found out whether the backend
/// follows what a case asks.
struct AskedDrawing {
  std::optional<cases::Coverage> coverage;
  std::optional<cases::Basis> basis;
  std::optional<cases::TieRule> fill_rule;
};

struct ProbeOptions {
  std::uint64_t seed = 1;
  int cases = 20;  ///< random ones of each generator, from 1
  AskedDrawing asked;
};

/// Measures the backend; `name` is its specification. Fails where it draws nothing at all, or is
/// lost on the way (Backend::is_lost).
Result<records::Probe> probe(const std::string& name, backends::Backend& backend,
                             const ProbeOptions& options, const Progress& progress);

}  // namespace rastercheck::properties
