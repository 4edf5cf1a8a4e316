// run.json: everything that a run found. All of it, except "environment", depends only on the run's
// seed and settings, to the byte. reports/run_reader.h reads it back.
//
//   {
//     "format": "rastercheck-run",
//     "version": 3,             records::kRecordsVersion
//     "rules_version": 1,       records::kRulesVersion
//     "plan": {…},              records/plan_json.h
//     "sentences": {"ID": "…"},
//     "shard": {…},             records/shard_json.h; only for a shard
//     "cases_left": 120,        only if the run was interrupted
//     "records": […],           records/record_json.h
//     "cases": […],             records/case_record_json.h; only if they are kept
//     "outcomes": […],          records/case_outcomes_json.h; only for several backends
//     "differences": […],       the same; only if two backends disagree
//     "specimens": […],         records/specimen_json.h; only if there are any
//     "counterexamples": […],   records/counterexample_json.h
//     "inspections": […],       records/inspection_json.h; only if there are any
//     "unreached": [{"property": "…", "backend": "cpu", "label": "tie", "reached": 2, "least": 13,
//                    "checked": 1000}],
//     "known": […],             records/known_json.h; only if a driver has known defects
//     "unexpected_passes": […], the same; only if there are any
//     "scenes": [{"file": "bunny.obj", "backend": "cpu", "triangles": 69666, "fragments": 51234,
//                 "judged": 51234, "wrong": 0, "not_judged": {}}],   only if there is a scene
//     "pictures": [{"name": "…", "caption": "…", "width": 640, "height": 480, "png": "base64…"}],
//     "environment": {"version": "0.1.0", …}
//   }
//
// Each record, case, difference, specimen, counterexample, inspection and picture takes one line,
// so that a text comparison of two runs shows which of them differ.

#include <nlohmann/json.hpp>

#include "cases/json_document.h"
#include "reports/format.h"
#include "reports/internal/run_members.h"

namespace rastercheck::reports::run_json_format {
namespace {

std::string write(const records::Run& run) { return cases::document_of(run) + "\n"; }

const FormatRegistration kRegistration({"json", "run.json", &write});

}  // namespace
}  // namespace rastercheck::reports::run_json_format
