#include "records/baseline_json.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "cases/files.h"
#include "cases/json.h"
#include "cases/json_node.h"
#include "records/case_record_json.h"
#include "records/enclosure_json.h"
#include "records/plan_json.h"
#include "records/record_json.h"
#include "records/specimen_json.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using nlohmann::json;
using nlohmann::ordered_json;

// --- Writing -------------------------------------------------------------------------------------

template <typename Json>
std::string json_text(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A list, each element on a line of its own.
class Lines {
 public:
  explicit Lines(char open) : text_(1, open) {}
  void add(const std::string& line) {
    text_ += (is_empty_ ? "\n" : ",\n") + line;
    is_empty_ = false;
  }
  std::string end(char close) && { return std::move(text_) + (is_empty_ ? "" : "\n") + close; }

 private:
  std::string text_;
  bool is_empty_ = true;
};

ordered_json entry_json(const CaseCounts& counts) {
  ordered_json object{{"checked", counts.checked}};
  if (counts.not_applicable > 0) object["not_applicable"] = counts.not_applicable;
  if (counts.violations > 0) object["violations"] = counts.violations;
  if (counts.known > 0) object["known"] = counts.known;
  return object;
}

ordered_json entry_json(const ClassCounts& classes) {
  ordered_json object = ordered_json::object();
  for (std::size_t i = 0; i < classes.counts.size(); ++i) {
    if (classes.counts[i] == 0) continue;
    object[std::string(to_string(static_cast<FragmentClass>(i)))] = classes.counts[i];
  }
  return object;
}

std::string line_of(const EntryKey& key, const EntryFigures& figures) {
  ordered_json object{{"law", key.law}, {"kind", to_string(key.kind)}};
  if (key.stratum) object["stratum"] = to_string(*key.stratum);
  if (figures.cases != CaseCounts()) object["cases"] = entry_json(figures.cases);
  if (figures.classes != ClassCounts()) object["classes"] = entry_json(figures.classes);
  if (figures.worst != Enclosure()) {
    object["worst"] = cases::json_of(figures.worst);
  }
  if (figures.histogram != Histogram()) {
    object["histogram"] = cases::json_of(figures.histogram);
  }
  for (const auto& [stage, sum] : figures.stages) {
    object["stages"][std::string(to_string(stage))] = cases::json_of(sum);
  }
  return json_text(object);
}

std::string line_of(const CaseNumber& number, const CaseFigures& figures) {
  ordered_json object{{std::string(to_string(number.first)), number.second},
                      {"found", digest_text(figures.found_digest)}};
  if (figures.outcome != CaseOutcome::held) {
    object["outcome"] = to_string(figures.outcome);
  }
  if (figures.mismatches > 0) object["mismatches"] = figures.mismatches;
  if (!figures.worst.empty()) object["worst"] = cases::json_of(figures.worst);
  return json_text(object);
}

std::string line_of(const Approval& approval) {
  return json_text(ordered_json{{"reason", approval.reason},
                                {"version", approval.version},
                                {"commit", approval.commit},
                                {"changes", approval.changes}});
}

std::string line_of(const Taken& taken) {
  return json_text(ordered_json{{"backend", taken.backend},
                                {"version", taken.version},
                                {"commit", taken.commit},
                                {"instruction_set", taken.instruction_set},
                                {"compiler", taken.compiler}});
}

std::string json_text(const BaselineSection& section) {
  std::string text = "{\n";
  const auto add = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("{}\"{}\": {}", text.size() > 2 ? ",\n" : "", key, value);
  };
  const BaselineKey& key = section.key;
  add("backend", cases::json_string(key.backend));
  add("architecture", cases::json_string(key.architecture));
  if (!key.instruction_set.empty()) add("instruction_set", cases::json_string(key.instruction_set));
  if (!key.compiler.empty()) add("compiler", cases::json_string(key.compiler));
  add("records_version", std::to_string(section.records_version));
  add("rules_version", std::to_string(section.rules_version));
  add("plan", json_text(cases::json_of(section.plan)));
  add("taken", line_of(section.taken));
  Lines approvals('[');
  for (const Approval& approval : section.approvals) approvals.add(line_of(approval));
  add("approvals", std::move(approvals).end(']'));
  Lines entries('[');
  for (const auto& [of, figures] : section.entries) entries.add(line_of(of, figures));
  add("entries", std::move(entries).end(']'));
  Lines laws('[');
  for (const auto& [law, of] : section.laws) {
    laws.add(json_text(
        ordered_json{{"law", law}, {"cases", of.count}, {"digest", digest_text(of.digest)}}));
  }
  add("laws", std::move(laws).end(']'));
  Lines corpus('[');
  for (const auto& [index, name] : section.corpus) {
    corpus.add(json_text(ordered_json::array({index, name})));
  }
  add("corpus", std::move(corpus).end(']'));
  Lines cases_by_law('[');
  for (const auto& [law, of] : section.laws) {
    Lines each('[');
    for (const auto& [number, figures] : of.cases) each.add(line_of(number, figures));
    cases_by_law.add(fmt::format("{{\"law\": {}, \"cases\": {}}}", cases::json_string(law),
                                 std::move(each).end(']')));
  }
  add("cases", std::move(cases_by_law).end(']'));
  Lines specimens('[');
  for (const Specimen& specimen : section.specimens) {
    specimens.add(json_text(cases::json_of(specimen)));
  }
  if (!section.specimens.empty()) add("specimens", std::move(specimens).end(']'));
  return text + "\n}";
}

// --- Reading -------------------------------------------------------------------------------------

std::vector<std::string> read_text_list(const JsonNode& node) {
  std::vector<std::string> texts;
  for (const JsonNode& element : node.elements()) texts.push_back(element.text());
  return texts;
}

CaseCounts read_entry_counts(const JsonNode& node) {
  node.expect_object({"checked"}, {"not_applicable", "violations", "known"});
  const auto count = [&node](std::string_view key) {
    return node.has(key) ? node[key].count() : 0;
  };
  return {node["checked"].count(), count("not_applicable"), count("violations"), count("known")};
}

ClassCounts read_entry_classes(const JsonNode& node) {
  constexpr auto kNames = names_of(FragmentClass{});
  ClassCounts classes;
  node.expect_object({}, std::span(kNames).first(classes.counts.size()));
  for (std::size_t i = 0; i < classes.counts.size(); ++i) {
    if (node.has(kNames[i])) classes.counts[i] = node[kNames[i]].count();
  }
  return classes;
}

std::map<Stage, SignedSum> read_stage_sums(const JsonNode& node) {
  constexpr auto kNames = names_of(Stage{});
  node.expect_object({}, kNames);
  std::map<Stage, SignedSum> stages;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (node.has(kNames[i])) {
      stages[static_cast<Stage>(i)] = cases::read_as<SignedSum>(node[kNames[i]]);
    }
  }
  return stages;
}

std::pair<EntryKey, EntryFigures> read_entry_line(const JsonNode& node) {
  node.expect_object({"law", "kind"},
                     {"stratum", "cases", "classes", "worst", "histogram", "stages"});
  EntryKey key{node["law"].text(), node["kind"].enumerator<AttributeKind>(), std::nullopt};
  if (node.has("stratum")) key.stratum = node["stratum"].enumerator<Stratum>();
  EntryFigures figures;
  if (node.has("cases")) figures.cases = read_entry_counts(node["cases"]);
  if (node.has("classes")) figures.classes = read_entry_classes(node["classes"]);
  if (node.has("worst")) {
    figures.worst = cases::read_as<Enclosure>(node["worst"]);
    if (figures.worst.lo < 0) node["worst"].refuse("is a magnitude and must not be below 0");
  }
  if (node.has("histogram")) figures.histogram = cases::read_as<Histogram>(node["histogram"]);
  if (node.has("stages")) figures.stages = read_stage_sums(node["stages"]);
  return {std::move(key), std::move(figures)};
}

Taken read_taken(const JsonNode& node) {
  node.expect_object({"backend", "version", "commit", "instruction_set", "compiler"});
  return {node["backend"].text(), node["version"].text(), node["commit"].text(),
          node["instruction_set"].text(), node["compiler"].text()};
}

Approval read_approval(const JsonNode& node) {
  node.expect_object({"reason", "version", "commit", "changes"});
  Approval approval{node["reason"].text(), node["version"].text(), node["commit"].text(),
                    read_text_list(node["changes"])};
  if (approval.reason.empty()) node["reason"].refuse("must not be empty");
  return approval;
}

void read_case(const JsonNode& node, const BaselineSection& section, LawCases& law) {
  constexpr std::string_view kCorpus = to_string(Origin::corpus);
  constexpr std::string_view kRandom = to_string(Origin::random);
  const bool is_corpus = node.has(kCorpus);
  node.expect_object({is_corpus ? kCorpus : kRandom, "found"}, {"outcome", "mismatches", "worst"});
  const CaseNumber number{is_corpus ? Origin::corpus : Origin::random,
                          node[is_corpus ? kCorpus : kRandom].count()};
  std::string name;
  if (const auto known = section.corpus.find(number.second);
      is_corpus && known != section.corpus.end()) {
    name = known->second;
  }
  CaseFigures figures;
  figures.found_digest = digest_from_json(node["found"]);
  if (node.has("outcome")) {
    figures.outcome = node["outcome"].enumerator<CaseOutcome>();
    if (figures.outcome == CaseOutcome::not_applicable) {
      node["outcome"].refuse("must be that of a case that the law says something of");
    }
  }
  if (node.has("mismatches")) figures.mismatches = node["mismatches"].count();
  if (node.has("worst")) {
    figures.worst = cases::read_as<WorstOfCase>(node["worst"]);
    name_case(figures.worst, number.second, name);
  }
  if (!law.cases.emplace(number, std::move(figures)).second) {
    node.refuse("a second case of the same number");
  }
}

void read_laws(const JsonNode& node, BaselineSection& section) {
  for (const JsonNode& one : node["laws"].elements()) {
    one.expect_object({"law", "cases", "digest"});
    LawCases law;
    law.count = one["cases"].count();
    law.digest = digest_from_json(one["digest"]);
    if (!section.laws.emplace(one["law"].text(), law).second) {
      one.refuse("a second law of the same name");
    }
  }
  for (const JsonNode& one : node["corpus"].elements()) {
    const auto [index, name] = one.two_elements("index and name");
    if (!section.corpus.emplace(index.count(), name.text()).second) {
      one.refuse("a second case of the same index");
    }
  }
  for (const JsonNode& one : node["cases"].elements()) {
    one.expect_object({"law", "cases"});
    if (one.failed()) return;
    const auto of = section.laws.find(one["law"].text());
    if (of == section.laws.end()) {
      one["law"].refuse("is none that \"laws\" has");
      return;
    }
    for (const JsonNode& each : one["cases"].elements()) {
      if (each.failed()) return;
      read_case(each, section, of->second);
    }
  }
}

BaselineSection read_section(const JsonNode& node) {
  node.expect_object({"backend", "architecture", "records_version", "rules_version", "plan",
                      "taken", "approvals", "entries", "laws", "corpus", "cases"},
                     {"instruction_set", "compiler", "specimens"});
  BaselineSection section;
  if (node.failed()) return section;
  // Of files from before names were so, too.
  section.key.backend = section_name(node["backend"].text());
  section.key.architecture = node["architecture"].text();
  if (node.has("instruction_set")) section.key.instruction_set = node["instruction_set"].text();
  if (node.has("compiler")) section.key.compiler = node["compiler"].text();
  section.records_version = node["records_version"].count();
  section.rules_version = node["rules_version"].count();
  section.plan = cases::read_as<Plan>(node["plan"]);
  section.taken = read_taken(node["taken"]);
  for (const JsonNode& one : node["approvals"].elements()) {
    section.approvals.push_back(read_approval(one));
  }
  for (const JsonNode& one : node["entries"].elements()) {
    if (one.failed()) return section;
    if (!section.entries.insert(read_entry_line(one)).second) {
      one.refuse("a second entry of the same law, kind and stratum");
    }
  }
  read_laws(node, section);
  if (node.has("specimens"))
    section.specimens = cases::read_as<std::vector<Specimen>>(node["specimens"]);
  return section;
}

Baseline read_baseline_document(const JsonNode& root) {
  // These first: of a later version, its unknown keys are not what is wrong.
  root.expect_format("rastercheck-baseline");
  if (root.has("version") && root["version"].count() != kBaselineVersion) {
    root["version"].refuse(fmt::format("version must be {}", kBaselineVersion));
  }
  root.expect_object({"format", "version", "sections"});
  Baseline baseline;
  for (const JsonNode& node : root["sections"].elements()) {
    if (root.failed()) break;
    BaselineSection section = read_section(node);
    const std::size_t before = baseline.sections.size();
    put(baseline, std::move(section));
    if (baseline.sections.size() == before) node.refuse("a second section of the same key");
  }
  return baseline;
}

}  // namespace

std::string to_json(const Baseline& baseline) {
  Lines sections('[');
  for (const BaselineSection& section : baseline.sections) sections.add(json_text(section));
  return fmt::format(
      "{{\n\"format\": \"rastercheck-baseline\",\n\"version\": {},\n\"sections\": {}\n}}\n",
      kBaselineVersion, std::move(sections).end(']'));
}

Result<Baseline> parse_baseline(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &read_baseline_document);
}

Result<Baseline> read_baseline(const std::string& file) {
  return cases::read_text(file).and_then(
      [&file](const std::string& text) { return parse_baseline(text, file); });
}

}  // namespace rastercheck::records
