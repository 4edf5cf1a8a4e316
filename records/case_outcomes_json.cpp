#include "records/case_outcomes_json.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cases/case_reader.h"
#include "cases/case_writer.h"

namespace rastercheck::records {

using cases::Either;
using cases::JsonNode;
using nlohmann::json;

void write_value(json& to, const IndexSet& set);
void read_value(const JsonNode& node, IndexSet& set);

void write_value(json& to, const IndexSet& set) {
  to = json::array();
  for (const auto& [first, last] : set.ranges()) to.push_back(json::array({first, last}));
}

void read_value(const JsonNode& node, IndexSet& set) {
  std::vector<IndexSet::Range> ranges;
  for (const JsonNode& pair : node.elements()) {
    const auto [from, to] = pair.two_elements("first and last");
    const IndexSet::Range range{from.count(), to.count()};
    const bool is_first = ranges.empty();
    if (range.first > range.last || (!is_first && (range.first <= ranges.back().last ||
                                                   range.first - 1 == ranges.back().last))) {
      pair.refuse("ranges must ascend, with a gap between two of them");
    }
    if (node.failed()) return;
    ranges.push_back(range);
  }
  set = IndexSet(std::move(ranges));
}

template <typename Archive, Either<OutcomeKey> Key, Either<CaseOutcomes> T>
void members(Archive& archive, Key& key, T& outcomes) {
  archive.required("property", key.law);
  archive.required("backend", key.backend);
  archive.required("origin", key.origin);
  archive.optional("right", outcomes.right);
  archive.optional("wrong", outcomes.wrong);
  archive.optional("known", outcomes.known);
  archive.optional("unlike", outcomes.unlike);
  archive.check([&](const JsonNode& node) {
    const IndexSet judged = judged_of(outcomes);
    const bool has_one_outcome = common(outcomes.right, outcomes.wrong).empty() &&
                                 common(outcomes.right, outcomes.known).empty() &&
                                 common(outcomes.wrong, outcomes.known).empty();
    if (!has_one_outcome) node.refuse("each case must have one outcome");
    for (const auto& [backend, unlike] : outcomes.unlike) {
      if (!without(unlike, judged).empty()) node["unlike"].refuse("must name judged cases only");
    }
  });
}

void write_value(json& to, const CaseOutcomeSet::value_type& one) {
  cases::write_object(to, [&](auto& archive) { members(archive, one.first, one.second); });
}
void write_value(json& to, const CaseOutcomeSet& outcomes) { cases::write_entries(to, outcomes); }
void read_value(const JsonNode& node, CaseOutcomeSet& outcomes) {
  cases::read_entries(node, outcomes, "entry with the same property, backend and origin");
}

template <typename Archive, Either<Difference> T>
void members(Archive& archive, T& difference) {
  archive.required("case", difference.source);
  archive.required("right", difference.right);
  archive.required("origin", difference.origin);
  archive.check([&](const JsonNode& node) {
    if (!difference.source.found) node["case"].refuse("has no 'found'");
  });
}

void write_value(json& to, const Difference& difference) { cases::write_members(to, difference); }
void read_value(const JsonNode& node, Difference& difference) {
  cases::read_members(node, difference);
}

}  // namespace rastercheck::records
