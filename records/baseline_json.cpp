#include "records/baseline_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "cases/files.h"
#include "cases/json_document.h"
#include "records/case_record_json.h"
#include "records/enclosure_json.h"
#include "records/plan_json.h"
#include "records/record_json.h"
#include "records/specimen_json.h"

namespace rastercheck::records {
namespace {

using cases::Either;
using cases::JsonNode;

constexpr std::string_view kBaselineFormat = "rastercheck-baseline";

}  // namespace

template <typename Archive, Either<Taken> T>
void members(Archive& archive, T& taken) {
  archive.required("backend", taken.backend);
  archive.required("version", taken.version);
  archive.required("commit", taken.commit);
  archive.required("instruction_set", taken.instruction_set);
  archive.required("compiler", taken.compiler);
}

template <typename Archive, Either<Approval> T>
void members(Archive& archive, T& approval) {
  archive.required("reason", approval.reason);
  archive.required("version", approval.version);
  archive.required("commit", approval.commit);
  archive.required("changes", approval.changes);
  archive.check([&](const JsonNode& node) {
    if (approval.reason.empty()) node["reason"].refuse("must not be empty");
  });
}

template <typename Archive, Either<EntryKey> Key, Either<EntryFigures> T>
void members(Archive& archive, Key& key, T& figures) {
  archive.required("property", key.law);
  archive.required("kind", key.kind);
  archive.optional("stratum", key.stratum);
  archive.optional_object("cases", figures.cases, [](auto& inner, auto& counts) {
    inner.required("checked", counts.checked);
    inner.optional("not_applicable", counts.not_applicable);
    inner.optional("violations", counts.violations);
    inner.optional("known", counts.known);
  });
  archive.optional("power", figures.power);
  archive.optional_object("classes", figures.classes, [](auto& inner, auto& classes) {
    for (std::size_t i = 0; i < classes.counts.size(); ++i) {
      inner.optional(to_string(static_cast<FragmentClass>(i)), classes.counts[i]);
    }
  });
  archive.optional("not_judged", figures.not_judged);
  archive.optional("worst", figures.worst);
  archive.optional("histogram", figures.histogram);
  archive.optional_object("stages", figures.stages,
                          [](auto& inner, auto& stages) { inner.entries(stages); });
  archive.check([&](const JsonNode& node) {
    if (figures.worst.lo < 0) node["worst"].refuse("is a magnitude and must not be negative");
  });
}

/// "properties": the members of a property that do not belong to single cases.
template <typename Archive, Either<std::string> Key, Either<LawCases> T>
void members(Archive& archive, Key& law, T& of) {
  archive.required("property", law);
  archive.required("cases", of.count);
  archive.required("digest", DigestText{of.digest});
}

/// When reading, `number` must already have its origin, because the number's key is the origin's
/// name.
template <typename Archive, Either<CaseNumber> Key, Either<CaseFigures> T>
void members(Archive& archive, Key& number, T& figures) {
  archive.required(to_string(number.first), number.second);
  archive.required("found", DigestText{figures.found_digest});
  archive.optional("outcome", figures.outcome, CaseOutcome::held);
  archive.optional("mismatches", figures.mismatches);
  archive.optional("worst", figures.worst);
  archive.check([&](const JsonNode& node) {
    if (figures.outcome == CaseOutcome::not_applicable) {
      node["outcome"].refuse("must be the outcome of a case to which the property applies");
    }
  });
}

namespace {

/// "corpus": [index, name] of each corpus case.
template <typename T>
struct CorpusNames {
  T& names;

  std::string text() const {
    cases::JsonLines lines;
    for (const auto& [index, name] : names) {
      lines.add(fmt::format("[{},{}]", index, cases::json_string(name)));
    }
    return std::move(lines).end();
  }

  friend void read_value(const JsonNode& node, CorpusNames& corpus) {
    for (const JsonNode& one : node.elements()) {
      const auto [index, name] = one.two_elements("index and name");
      if (!corpus.names.emplace(index.count(), name.text()).second) {
        one.refuse("a second case with the same index");
      }
    }
  }
};
template <typename T>
CorpusNames(T&) -> CorpusNames<T>;

void read_case(const JsonNode& node, const BaselineSection& section, LawCases& law) {
  const bool is_corpus = node.has(to_string(Origin::corpus));
  CaseNumber number{is_corpus ? Origin::corpus : Origin::random, 0};
  CaseFigures figures;
  cases::read_object(node, [&](auto& archive) { members(archive, number, figures); });
  const auto named = is_corpus ? section.corpus.find(number.second) : section.corpus.end();
  name_case(figures.worst, number.second, named == section.corpus.end() ? "" : named->second);
  if (!law.cases.emplace(number, std::move(figures)).second) {
    node.refuse("a second case with the same number");
  }
}

/// "cases": the single cases of each law. When reading, the section must already have its laws and
/// its corpus.
template <typename T>
struct CasesByLaw {
  T& section;

  std::string text() const {
    cases::JsonLines laws;
    for (const auto& [law, of] : section.laws) {
      laws.add(fmt::format("{{\"property\": {}, \"cases\": {}}}", cases::json_string(law),
                           cases::TextWriter::text_of(of.cases)));
    }
    return std::move(laws).end();
  }

  friend void read_value(const JsonNode& node, CasesByLaw& cases) {
    for (const JsonNode& one : node.elements()) {
      one.expect_object({"property", "cases"});
      if (one.failed()) return;
      const auto of = cases.section.laws.find(one["property"].text());
      if (of == cases.section.laws.end()) {
        one["property"].refuse("is not in \"properties\"");
        return;
      }
      for (const JsonNode& each : one["cases"].elements()) {
        if (each.failed()) return;
        read_case(each, cases.section, of->second);
      }
    }
  }
};
template <typename T>
CasesByLaw(T&) -> CasesByLaw<T>;

}  // namespace

/// The members in the order of the file.
template <typename Archive, Either<BaselineSection> T>
void members(Archive& archive, T& section) {
  archive.required("backend", section.key.backend);
  archive.required("architecture", section.key.architecture);
  archive.optional("instruction_set", section.key.instruction_set);
  archive.optional("compiler", section.key.compiler);
  archive.required("records_version", section.records_version);
  archive.required("rules_version", section.rules_version);
  archive.required("plan", section.plan);
  archive.required("taken", section.taken);
  archive.required("approvals", section.approvals);
  archive.list("entries", section.entries, "entry with the same property, kind and stratum");
  archive.list("properties", section.laws, "property with the same name");
  archive.required("corpus", CorpusNames{section.corpus});
  archive.required("cases", CasesByLaw{section});
  archive.optional("specimens", section.specimens);
}

namespace {

Baseline read_baseline_document(const JsonNode& root) {
  std::vector<BaselineSection> sections;
  cases::read_object(root, [&](auto& archive) {
    archive.format(kBaselineFormat, kBaselineVersion);
    archive.required("sections", sections);
  });
  Baseline baseline;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    // Older files may have names that are not in normal form.
    sections[i].key.backend = section_name(sections[i].key.backend);
    put(baseline, std::move(sections[i]));
    if (baseline.sections.size() == i) {
      root["sections"].elements()[i].refuse("a second section with the same key");
      break;
    }
  }
  return baseline;
}

}  // namespace

std::string to_json(const Baseline& baseline) {
  cases::JsonLines sections;
  for (const BaselineSection& section : baseline.sections) {
    sections.add(cases::document_of(section));
  }
  return fmt::format("{{\n\"format\": \"{}\",\n\"version\": {},\n\"sections\": {}\n}}\n",
                     kBaselineFormat, kBaselineVersion, std::move(sections).end());
}

Result<Baseline> parse_baseline(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &read_baseline_document);
}

Result<Baseline> read_baseline(const std::string& file) {
  return cases::read_text(file).and_then(
      [&file](const std::string& text) { return parse_baseline(text, file); });
}

}  // namespace rastercheck::records
