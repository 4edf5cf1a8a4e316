#include "records/inspection_json.h"

#include <nlohmann/json.hpp>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "records/enclosure_json.h"
#include "records/internal/shared_members.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const WindowPoint& point) {
  to = nlohmann::json::array({cases::float64_to_json(point.x), cases::float64_to_json(point.y)});
}
void read_value(const cases::JsonNode& node, WindowPoint& point) {
  const auto [x, y] = node.two_elements("x and y");
  point = {x.float64(), y.float64()};
}

template <typename Archive, cases::Either<InspectedValue> T>
void members(Archive& archive, T& value) {
  archive.optional("attribute", value.attribute);
  archive.optional("exact", value.exact);
  archive.optional("nearest", value.nearest);
  archive.optional("actual", value.actual);
  archive.optional("scale_error", value.scale_error);
  archive.optional("local_error", value.local_error);
  archive.optional("excess", value.excess);
  archive.optional("kappa", value.kappa);
  archive.optional("kappa_d", value.kappa_d);
}

/// Leaves out the sample's triangle, which is the same for the whole inspection.
template <typename Archive, cases::Either<InspectedSample> T>
void members(Archive& archive, T& sample) {
  archive.required("x", sample.place.x);
  archive.required("y", sample.place.y);
  archive.required("sample", sample.place.sample);
  archive.required("verdict", sample.verdict);
  archive.required("reason", sample.reason);
  archive.required("is_drawn", sample.is_drawn);
  archive.optional("distance", sample.distance);
  archive.optional("edges", sample.edges);
  archive.optional("values", sample.values);
}

template <typename Archive, cases::Either<StagePart> T>
void members(Archive& archive, T& part) {
  archive.required("stage", part.stage);
  archive.required("error", part.error);
}

template <typename Archive, cases::Either<ErrorSplit> T>
void members(Archive& archive, T& split) {
  archive.required("parts", split.parts);
  archive.required("total", split.total);
  archive.required("is_traced", split.is_traced);
  archive.optional("attribute", split.attribute);
}

namespace {

/// Refuses a sample outside the inspected part, because a report would have no picture of it.
void check_place(const cases::JsonNode& node, const InspectedSample& sample,
                 const Inspection& whole) {
  const bool is_within = sample.place.x >= whole.left &&
                         sample.place.x - whole.left < whole.width && sample.place.y >= whole.top &&
                         sample.place.y - whole.top < whole.height;
  if (!is_within) node.refuse("not within the inspected part");
  if (sample.place.sample >= whole.pattern.size()) {
    node["sample"].refuse("not in the sample pattern");
  }
}

}  // namespace

template <typename Archive, cases::Either<Inspection> T>
void members(Archive& archive, T& inspection) {
  archive.required("occasion", inspection.occasion);
  archive.required("property", inspection.law);
  archive.required("backend", inspection.backend);
  archive.required("counterexample", inspection.counterexample);
  archive.optional("kind", inspection.kind);
  archive.optional("stratum", inspection.stratum);
  archive.required("case", inspection.source);
  archive.required("pattern", inspection.pattern);
  members(archive, inspection.place);
  archive.optional("attribute", inspection.attribute);
  archive.optional("q_matrix", inspection.q_matrix);
  archive.required("outlines", inspection.outlines);
  archive.required("left", inspection.left);
  archive.required("top", inspection.top);
  archive.required("width", cases::UpTo{inspection.width, kMostInspected});
  archive.required("height", cases::UpTo{inspection.height, kMostInspected});
  archive.required("samples", inspection.samples);
  archive.required("splits", inspection.splits);
  archive.optional("coverage_stage", inspection.coverage_stage);
  archive.check([&](const cases::JsonNode& node) {
    const std::vector<cases::JsonNode> samples = node["samples"].elements();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      check_place(samples[i], inspection.samples[i], inspection);
    }
  });
}

void write_value(nlohmann::json& to, const Inspection& inspection) {
  cases::write_members(to, inspection);
}
void read_value(const cases::JsonNode& node, Inspection& inspection) {
  cases::read_members(node, inspection);
}

}  // namespace rastercheck::records
