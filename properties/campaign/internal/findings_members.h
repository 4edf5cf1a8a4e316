#pragma once

// Findings as members of files, except the fault.

#include "cases/json_members.h"
#include "properties/campaign/findings.h"
#include "records/case_outcomes_json.h"
#include "records/case_record_json.h"
#include "records/counterexample_json.h"
#include "records/known_json.h"
#include "records/record_json.h"

namespace rastercheck::properties {

template <typename Archive, cases::Either<Findings> T>
void members(Archive& archive, T& findings) {
  archive.required("records", findings.records);
  archive.optional("cases", findings.cases);
  archive.optional("outcomes", findings.outcomes);
  archive.required("counterexamples", findings.counterexamples);
  archive.optional("unexpected", findings.unexpected);
  archive.check([&](const cases::JsonNode& node) {
    const auto& all = findings.counterexamples;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].source.found) continue;  // `found` orders the counterexamples
      node["counterexamples"].elements()[i].refuse("its case has no 'found'");
    }
  });
}

}  // namespace rastercheck::properties
