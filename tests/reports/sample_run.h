#pragma once

// A run in which every member is set, with texts that need escaping.

#include <cstdint>
#include <limits>
#include <string>

#include "records/run.h"
#include "tests/reports/sample_inspections.h"

namespace rastercheck::reports {

inline cases::Case sample_case(const std::string& law, const std::string& backend,
                               std::uint64_t index) {
  cases::Case c;
  c.name = "a <b>bold</b> | \"case\"";
  c.framebuffer = {64, 48, 4};
  c.viewport = {0, 0, 64, 48, 0, 1};
  c.coverage = cases::Snapping{};
  c.attributes = {{"u & v"}};
  c.positions = {{0, -0.0F, 0, 1}, {0x1p-149F, 1, 0, 1}, {1, 1, 0.5F, 3}};
  c.attribute_values = {1, 0x1.fffffep+127F, -0.0F};
  c.triangles = {{0, 1, 2}};
  c.found = {law, backend, index == 3 ? "beyond bound" : "missing", 1, index};
  return c;
}

inline records::Counterexample sample_counterexample(std::uint64_t index) {
  using namespace records;
  Violation value;
  value.fragment_class = FragmentClass::beyond_bound;
  value.kind = AttributeKind::smooth;
  value.place.x = 3;
  value.place.y = 5;
  value.place.sample = 2;
  value.attribute = 0;
  value.exact = "84/5";
  value.actual = "16.8000011 (0x1.0cccdp+4)";
  value.error = {0.7000000000000001, 0.7000000000000002};
  value.bound = {0.5, 0.5};
  Violation missing;
  missing.fragment_class = FragmentClass::missing;
  missing.place.x = 63;
  missing.exact = "required, inside";
  missing.actual = "not drawn";
  missing.distance = {0.125, 0.125};
  missing.note = "its neighbour <(64, 0)> was drawn";
  Counterexample found{
      sample_case("values are within bounds", "method:float32", index), 12, {value, missing}};
  found.origin = Origin::saved;
  found.shrinking = {214, index == 3};
  found.explanation = {{DrawnPart::values},
                       {},
                       {},
                       {"samples"},
                       {"scissor"},
                       {"tie", "small"},
                       {{"<y> points in the other direction"}}};
  found.close_up = {"y 5 [!]", "x    3", "! <wrong> & `more`"};
  return found;
}

inline records::WorstError sample_worst(double error) {
  records::WorstError worst;
  worst.error = {error, error};
  worst.exact = "1/3";
  worst.actual = 0.25F;
  worst.case_index = 17;
  worst.case_name = "slivers & <needles>";
  worst.place.x = 3;
  worst.place.y = 5;
  worst.attribute = 0;
  return worst;
}

/// Adds the findings of one law on one backend, in two strata.
inline void add_sample_records(records::RecordSet& into, const std::string& law,
                               const std::string& backend, std::uint64_t violations) {
  using namespace records;
  Record coverage;
  coverage.cases = {600, 3, violations};
  coverage.counts = {12000, 3000000, 40, 0};
  coverage.errors.classes[FragmentClass::correct] = 12010;
  coverage.errors.classes[FragmentClass::missing] = violations;
  coverage.labels = {{"tie", 4}, {"<clipped>", 57}};
  coverage.levels = {{2999000, 999, 1}, {12000, 0, 0}};
  coverage.power = {{Defect::moved_256th, {30, 29}}, {Defect::values_nan, {29, 29}}};
  into[{law, backend, AttributeKind::coverage, "grid"}] = coverage;
  coverage.cases = {400, 0, 0};
  coverage.labels = {{"tie", 1}};
  coverage.power.clear();
  into[{law, backend, AttributeKind::coverage, "sliver"}] = coverage;

  Record smooth;
  smooth.errors.classes[FragmentClass::correct] = 12000;
  smooth.errors.classes[FragmentClass::beyond_bound] = violations;
  smooth.errors.not_judged[records::NotJudged::not_promised] = 1234;
  for (const double error : {0.0, 0.001, 0.125, 0.25, 0.375, 0.5}) {
    const std::size_t bucket = Histogram::bucket_of(error);
    smooth.errors.ideal.histogram.add_to_bucket(bucket, 2000);
    smooth.errors.strata[Stratum::near_horizon].histogram.add_to_bucket(bucket, 500);
    smooth.errors.strata[Stratum::ordinary].histogram.add_to_bucket(bucket, 1500);
    smooth.errors.excess.histogram.add_to_bucket(Histogram::bucket_of(error / 2), 2000);
  }
  keep(smooth.errors.ideal.extremes, sample_worst(0.5));
  keep(smooth.errors.excess.extremes, sample_worst(-0.25));
  keep(smooth.errors.strata[Stratum::near_horizon].extremes, sample_worst(0.375));
  keep(smooth.errors.strata[Stratum::ordinary].extremes, sample_worst(0.5));
  // Means of 1/8, about 0 and about 1/6. The error added below has no sum, as in older files.
  constexpr SignedSum::Units kOne = SignedSum::Units{1} << 32;
  smooth.errors.ideal.sum.add(kOne * 1500, kOne * 1500, 12000);
  smooth.errors.strata[Stratum::near_horizon].sum.add(-2, 3, 3000);
  smooth.errors.strata[Stratum::ordinary].sum.add(kOne * 1500 - 9, kOne * 1500, 9000);
  if (violations > 0) {
    smooth.errors.ideal.histogram.add(0.7);
    smooth.errors.strata[Stratum::ordinary].histogram.add(0.7);
    keep(smooth.errors.strata[Stratum::ordinary].extremes, sample_worst(-0.7));
    smooth.errors.excess.histogram.add(0.7);
    keep(smooth.errors.ideal.extremes, sample_worst(-0.7));
    keep(smooth.errors.excess.extremes, sample_worst(0.7));
  }
  into[{law, backend, AttributeKind::smooth, "grid"}] = smooth;
}

/// Makes the run one of a driver with known defects: one that was seen, and one that is gone. Adds
/// a law that did not apply to any case.
inline void add_known_defects(records::Run& run) {
  records::KnownList list{records::KnownDriver{"driver", "Mesa 22"}, {{}, {}}};
  for (records::KnownEntry& entry : list.entries) {
    entry.id = &entry == &list.entries[0] ? "driver-1" : "driver-2";
    entry.reason = "Depth <is> wrong.";
    entry.rule = "14.6.1";
    entry.finding = entry.id;
    entry.laws = {run.plan.laws[0]};
    entry.verdicts = {records::FragmentClass::missing};
    entry.when.facts[records::KnownFact::clipped] = true;
    entry.case_file = "known/" + entry.id + ".json";
  }
  run.known = {{"cpu", "driver/known.json", "Mesa 23", list}};
  run.unexpected = {{"cpu", "driver-2", run.plan.laws[0], records::Staleness::other_version}};
  using records::AttributeKind;
  records::Record& seen = run.records[{run.plan.laws[0], "cpu", AttributeKind::coverage, "grid"}];
  seen.cases.known = 3;
  seen.known["driver-1"] = 3;
  records::Record& none = run.records[{run.plan.laws[2], "cpu", AttributeKind::coverage, "grid"}];
  none.cases.not_applicable = 9;
  none.not_applicable_because["the backend <draws> no pictures"] = 9;
}

/// The results of two cases.
inline records::CaseRecordSet sample_cases(const std::string& law, const std::string& backend) {
  using namespace records;
  CaseRecord of_corpus;
  of_corpus.name = "slivers & <needles>";
  of_corpus.stratum = kCorpusStratum;
  of_corpus.outcome = CaseOutcome::not_applicable;
  of_corpus.source_digest = 0x0123456789abcdefU;
  CaseRecord random;
  random.stratum = "grid";
  random.outcome = CaseOutcome::violated;
  random.source_digest = 1;
  random.found_digest = std::numeric_limits<std::uint64_t>::max();
  random.mismatches = 2;
  random.worst[AttributeKind::smooth][Stratum::ordinary] = sample_worst(-0.7);
  random.worst[AttributeKind::smooth][Stratum::ordinary].case_name.clear();
  random.worst[AttributeKind::depth][Stratum::near_horizon] = sample_worst(0.375);
  random.worst[AttributeKind::depth][Stratum::near_horizon].case_name.clear();
  random.worst[AttributeKind::depth][Stratum::near_horizon].attribute.reset();
  return {{{law, backend, Origin::corpus, 17}, of_corpus},
          {{law, backend, Origin::random, 17}, random}};
}

/// Outcomes of two backends on 60 random cases of a law: the second backend is wrong in two of
/// them, has a known defect in another and, for three numbers, got a different case.
inline records::CaseOutcomeSet sample_outcomes(const std::string& law,
                                               const std::vector<std::string>& backends) {
  using namespace records;
  CaseOutcomes first;
  first.right = IndexSet({{0, 59}});
  CaseOutcomes second;
  second.right = IndexSet({{0, 16}, {18, 40}, {44, 58}});
  second.wrong = IndexSet({{17, 17}, {41, 41}});
  second.known = IndexSet({{42, 42}});
  second.unlike[backends[0]] = IndexSet({{3, 5}});
  CaseOutcomes corpus;
  corpus.wrong = IndexSet({{7, 7}});
  return {{{law, backends[0], Origin::corpus}, corpus},
          {{law, backends[0], Origin::random}, first},
          {{law, backends[1], Origin::corpus}, corpus},
          {{law, backends[1], Origin::random}, second}};
}

inline records::Run sample_run() {
  records::Run run;
  run.plan.seed = std::numeric_limits<std::uint64_t>::max();
  run.plan.cases_per_law = 1000;
  run.plan.backends = {"cpu", "method:float32"};
  run.plan.laws = {"coverage is exact", "values are within bounds", "a law <that> says | nothing"};
  run.sentences = {{"coverage is exact", "coverage is <that> of the contract"}};
  run.plan.scene = "it's a bunny";
  run.plan.properties = {"*<values>*"};
  run.plan.timeout = 2.5;
  for (const std::string& backend : run.plan.backends) {
    add_sample_records(run.records, run.plan.laws[0], backend, 0);
    add_sample_records(run.records, run.plan.laws[1], backend, backend == "cpu" ? 0 : 2);
  }
  run.cases = sample_cases(run.plan.laws[1], run.plan.backends[1]);
  run.outcomes = sample_outcomes(run.plan.laws[1], run.plan.backends);
  run.differences = {
      {sample_case(run.plan.laws[1], run.plan.backends[1], 17), "cpu", records::Origin::random}};
  run.differences[0].source.found->verdict.clear();
  run.unreached = {{run.plan.laws[0], "cpu", "<clipped>", 57, 412, 1000}};
  run.counterexamples = {sample_counterexample(3), sample_counterexample(41)};
  run.causes = {{"cpu",
                 "values are wrong where a pixel has several samples",
                 {"samples"},
                 {"holds once values are corrected", "holds if: a pixel <has> one sample"},
                 {0, 1},
                 records::Hint{"<y> points in the other direction", 1, 2}}};
  run.inspections = {sample_counterexample_inspection(), sample_worst_inspection()};
  run.scenes = {
      {"it's a <bunny>", "cpu", 3, 2, 2, 0, 1, false, {}},
      {"it's a <bunny>", run.plan.backends[1], 3, 0, 0, 0, 0, false, {{"it <is> far", 3}}}};
  run.pictures = {{"bunny-cpu", "What cpu draws <of it>.", 64, 48, std::string("\x89PNG\0\xff", 6)},
                  {"bunny-error", "Its error.", 64, 80, "P"}};
  run.environment = {{"version", "0.1.0"}, {"compiler", "g++ <12> & more"}, {"seconds", "1.5"}};
  return run;
}

}  // namespace rastercheck::reports
