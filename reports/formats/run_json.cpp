// run.json: everything a run found. All but "environment" depends on the run's seed and settings
// alone, to the byte. Read again by reports/run_reader.h.
//
//   {
//     "format": "rastercheck-run",
//     "version": 3,             records::kRecordsVersion
//     "rules_version": 1,       records::kRulesVersion
//     "plan": {…},              records/plan_json.h
//     "sentences": {"ID": "…"},
//     "shard": {…},             records/shard_json.h; only of a shard
//     "cases_left": 120,        only of a run that was interrupted
//     "records": […],           records/record_json.h
//     "cases": […],             records/case_record_json.h; only where they are kept
//     "specimens": […],         records/specimen_json.h; only where there are any
//     "counterexamples": […],   records/counterexample_json.h
//     "inspections": […],       records/inspection_json.h; only where there are any
//     "unreached": [{"law": "…", "backend": "cpu", "label": "tie", "reached": 2, "least": 13,
//                    "checked": 1000}],
//     "known": […],             records/known_json.h; only where something is known of a driver
//     "unexpected_passes": […], the same; only where there are any
//     "scenes": [{"file": "bunny.obj", "backend": "cpu", "triangles": 69666, "fragments": 51234,
//                 "judged": 51234, "wrong": 0, "not_judged": {}}],   only where there is a scene
//     "pictures": [{"name": "…", "caption": "…", "width": 640, "height": 480, "png": "base64…"}],
//     "environment": {"version": "0.1.0", …}
//   }
//
// A record, a case, a specimen, a counterexample, an inspection and a picture take a line each, so
// that a text comparison of two runs shows which differ.

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
