#pragma once

// The members of run.json, in the order of the file, except those of pictures and labels: run.json
// writes each picture and label on a single line, with keys in alphabetical order.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "cases/base64.h"
#include "cases/json_members.h"
#include "records/case_outcomes_json.h"
#include "records/case_record_json.h"
#include "records/counterexample_json.h"
#include "records/inspection_json.h"
#include "records/known_json.h"
#include "records/plan_json.h"
#include "records/record_json.h"
#include "records/run.h"
#include "records/shard_json.h"
#include "records/specimen_json.h"

namespace rastercheck::reports {

/// Bytes as Base64 text.
template <typename T>
struct Base64Text {
  T& bytes;

  friend void write_value(nlohmann::json& to, const Base64Text& view) {
    cases::write_value(to, cases::to_base64(view.bytes));
  }
  friend void read_value(const cases::JsonNode& node, Base64Text& view) {
    Result<std::string> read = cases::from_base64(node.text());
    if (!read) node.refuse(read.error().reason);
    view.bytes = std::move(read).value_or("");
  }
};
template <typename T>
Base64Text(T&) -> Base64Text<T>;

}  // namespace rastercheck::reports

namespace rastercheck::records {

template <typename Archive, cases::Either<Picture> T>
void members(Archive& archive, T& picture) {
  constexpr int kLargest = std::numeric_limits<int>::max();
  archive.required("caption", picture.caption);
  archive.required("height", cases::UpTo{picture.height, kLargest});
  archive.required("name", picture.name);
  archive.required("png", reports::Base64Text{picture.png});
  archive.required("width", cases::UpTo{picture.width, kLargest});
}

template <typename Archive, cases::Either<SceneResult> T>
void members(Archive& archive, T& scene) {
  archive.required("file", scene.file);
  archive.required("backend", scene.backend);
  archive.required("triangles", scene.triangles);
  archive.required("fragments", scene.fragments);
  archive.required("values", scene.values);
  archive.required("judged", scene.judged);
  archive.required("wrong", scene.wrong);
  archive.optional("is_known", scene.is_known);
  archive.optional("open", scene.open);
  archive.required("not_judged", scene.not_judged);
  archive.optional("values_not_judged", scene.values_not_judged);
  archive.check([&](const cases::JsonNode& node) {
    if (scene.wrong > scene.judged) node["wrong"].refuse("must not be more than were judged");
  });
}

template <typename Archive, cases::Either<Hint> T>
void members(Archive& archive, T& hint) {
  archive.required("change", hint.change);
  archive.required("right", hint.right);
  archive.required("wrong", hint.wrong);
  archive.check([&](const cases::JsonNode& node) {
    if (hint.right > hint.wrong) node["right"].refuse("must not be more than were wrong");
  });
}

template <typename Archive, cases::Either<Cause> T>
void members(Archive& archive, T& cause) {
  archive.required("backend", cause.backend);
  archive.required("sentence", cause.sentence);
  archive.required("needs", cause.needs);
  archive.required("tried", cause.tried);
  archive.optional("hint", cause.hint);
  archive.required("counterexamples", cause.counterexamples);
}

template <typename Archive, cases::Either<UnreachedLabel> T>
void members(Archive& archive, T& label) {
  archive.required("backend", label.backend);
  archive.required("checked", label.checked);
  archive.required("label", label.label);
  archive.required("property", label.law);
  archive.required("least", label.least);
  archive.required("reached", label.reached);
}

template <typename Archive, cases::Either<Run> T>
void members(Archive& archive, T& run) {
  archive.format("rastercheck-run", kRecordsVersion);
  archive.added("rules_version", run.rules_version, 1);  // older files follow version 1
  archive.required("plan", run.plan);
  archive.optional("sentences", run.sentences);
  archive.optional("shard", run.shard);
  archive.optional("cases_left", run.cases_left);
  archive.required("records", run.records);
  archive.optional("cases", run.cases);
  archive.optional("outcomes", run.outcomes);
  archive.optional("differences", run.differences);
  archive.optional("specimens", run.specimens);
  archive.required("counterexamples", run.counterexamples);
  archive.optional("causes", run.causes);
  archive.optional("inspections", run.inspections);
  archive.required("unreached", run.unreached);
  archive.optional("held_to", run.held_to);
  archive.optional("known", run.known);
  archive.optional("unexpected_passes", run.unexpected);
  archive.optional("scenes", run.scenes);
  archive.required("pictures", run.pictures);
  archive.required("environment", run.environment);
  archive.check([&](const cases::JsonNode& node) {
    for (const Cause& cause : run.causes) {
      const bool is_of_run =
          std::all_of(cause.counterexamples.begin(), cause.counterexamples.end(),
                      [&run](std::uint64_t place) { return place < run.counterexamples.size(); });
      if (cause.counterexamples.empty() || !is_of_run) {
        node["causes"].refuse("each must name counterexamples of the run");
      }
    }
    if (run.shard.has_value() != run.plan.shard.has_value()) {
      node.refuse("'shard' belongs to a plan with 'shard', and the other way round");
    }
  });
}

}  // namespace rastercheck::records
