#include "properties/campaign/scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "cases/json.h"
#include "oracle/judge.h"
#include "oracle/transform.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/shrink.h"
#include "properties/drawing.h"
#include "properties/judged_law.h"
#include "records/judged.h"
#include "records/record.h"

namespace rastercheck::properties {
namespace {

using oracle::JudgedSample;
using oracle::JudgedValue;
using records::FragmentClass;
using records::PixelState;

/// Gathers the judge's results for a scene: the error map and the first violations.
class SceneReader {
 public:
  /// `laws`: the laws that are asked for.
  SceneReader(const cases::Case& scene, const KnownDefects* known,
              const std::vector<std::string>& laws)
      : attributes_(scene.attributes.size()),
        known_(known),
        asks_of_coverage_(std::find(laws.begin(), laws.end(), kCoverageLaw) != laws.end()),
        asks_of_values_(std::find(laws.begin(), laws.end(), kValuesLaw) != laws.end()) {
    const cases::FramebufferSize& size = scene.framebuffer;
    map_.width = size.width;
    map_.height = size.height;
    const std::size_t pixels =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    map_.states.resize(pixels, PixelState::empty);
    map_.errors.resize(pixels, 0);
    depths_.resize(pixels, std::numeric_limits<float>::infinity());
  }

  /// Begins a part; `first_triangle` is the scene's index of its first triangle.
  void begin(const oracle::SceneTruth& part, std::size_t first_triangle) {
    part_ = &part;
    first_triangle_ = first_triangle;
  }

  void see(const JudgedSample& sample, const oracle::TriangleTruth* truth) {
    const bool is_in_map =
        std::cmp_less(sample.place.x, map_.width) && std::cmp_less(sample.place.y, map_.height);
    const std::size_t pixel =
        sample.place.y * static_cast<std::size_t>(map_.width) + sample.place.x;
    bool is_violated = sample.fragment_class != FragmentClass::correct;
    bool is_wrong = is_violated && asks_of_coverage_;
    if (is_violated) note_violation(found_.coverage, sample, nullptr, truth);
    for (const JudgedValue& value : sample.values) {
      if (value.fragment_class == FragmentClass::correct) continue;
      note_violation(found_.values, sample, &value, truth);
      is_violated = true;
      is_wrong = is_wrong || asks_of_values_;
    }
    const bool is_judged = is_violated || (sample.decision.verdict != records::Verdict::permitted &&
                                           sample.values.size() == attributes_ + 1);
    ++(is_judged ? judged_ : open_);
    if (is_wrong) ++wrong_;
    if (!is_in_map) return;
    if (is_violated) {
      map_.states[pixel] = PixelState::violated;
    } else if (map_.states[pixel] == PixelState::empty) {
      map_.states[pixel] = PixelState::correct;
    }
    see_nearest(sample, pixel);
  }

  records::ErrorMap take_map() { return std::move(map_); }
  std::uint64_t judged() const { return judged_; }  ///< samples
  std::uint64_t open() const { return open_; }      ///< samples
  std::uint64_t wrong() const { return wrong_; }    ///< samples
  /// For one law, the first violation of each class that no known-defect entry explains.
  struct Few {
    std::string_view law;
    std::set<FragmentClass> ways = {};
    std::vector<records::Violation> violations = {};
    std::set<std::string> known = {};  ///< ids of the entries that the known violations match
  };
  const Few& of(std::string_view law) const {
    return law == kCoverageLaw ? found_.coverage : found_.values;
  }

 private:
  void note_violation(Few& few, const JudgedSample& sample, const JudgedValue* value,
                      const oracle::TriangleTruth* truth) {
    const FragmentClass way = value == nullptr ? sample.fragment_class : value->fragment_class;
    if (few.ways.contains(way)) return;
    records::Violation violation = to_violation(sample, value, truth, *part_);
    if (known_ != nullptr) {
      auto ids = entries_of(*known_, few.law, part_->source(), violation);
      if (ids.empty()) ids = entries_of_drawing(*known_, part_->source(), violation);
      few.known.insert(ids.begin(), ids.end());
      if (!ids.empty()) return;
    }
    violation.place.triangle += static_cast<std::uint32_t>(first_triangle_);
    few.ways.insert(way);
    few.violations.push_back(std::move(violation));
  }

  /// The map shows the same fragment as the picture: the nearest of the pixel.
  void see_nearest(const JudgedSample& sample, std::size_t pixel) {
    if (sample.values.empty()) return;
    const float depth = sample.values.front().actual;
    if (!(depth < depths_[pixel])) return;
    depths_[pixel] = depth;
    double largest = 0;
    for (const JudgedValue& value : sample.values) {
      if (!value.attribute || !value.ideal) continue;
      largest = std::max(largest, records::magnitude_bound(*value.ideal));
    }
    map_.errors[pixel] = static_cast<float>(largest);
  }

  struct Found {
    Few coverage{kCoverageLaw};
    Few values{kValuesLaw};
  };

  const oracle::SceneTruth* part_ = nullptr;
  std::size_t first_triangle_ = 0;
  std::size_t attributes_;
  const KnownDefects* known_;
  bool asks_of_coverage_;
  bool asks_of_values_;
  records::ErrorMap map_;
  std::vector<float> depths_;
  std::uint64_t judged_ = 0;
  std::uint64_t open_ = 0;
  std::uint64_t wrong_ = 0;
  Found found_;
};

/// Returns the part of a judgement that concerns the coverage law.
records::Judgement coverage_part(const records::Judgement& all) {
  records::Judgement part;
  part.counts = all.counts;
  part.levels.samples = all.levels.samples;
  part.errors[records::AttributeKind::coverage] = all.errors.at(records::AttributeKind::coverage);
  return part;
}

/// Keeps a counterexample for each violation, under the index of its triangle.
void keep_violations(const Law& law, const std::string& specification, backends::Backend& backend,
                     std::uint64_t seed, NumberedCase numbered,
                     const std::vector<records::Violation>& violations, Findings& findings,
                     const KnownDefects* known) {
  for (const records::Violation& violation : violations) {
    numbered.index = violation.place.triangle;
    Check check;
    check.violation_count = 1;
    check.violations = {violation};
    keep_counterexample(law, specification, backend, seed, numbered, check, findings, known);
  }
}

/// Returns the laws on coverage and on values, if they were asked for.
std::vector<const Law*> scene_laws(const std::vector<std::string>& asked_for) {
  std::vector<const Law*> chosen;
  for (const std::string_view name : {kCoverageLaw, kValuesLaw}) {
    const Law* law = find_law(name);
    if (law == nullptr) continue;
    if (std::find(asked_for.begin(), asked_for.end(), name) != asked_for.end()) {
      chosen.push_back(law);
    }
  }
  return chosen;
}

/// Moves the places of errors from a part to the scene.
void move_triangles(records::Judgement& part, std::size_t first_triangle) {
  const auto move = [first_triangle](records::ErrorSizes& sizes) {
    for (auto* worst : {&sizes.extremes.most_negative, &sizes.extremes.most_positive}) {
      if (*worst) (*worst)->place.triangle += static_cast<std::uint32_t>(first_triangle);
    }
  };
  for (auto& [kind, errors] : part.errors) {
    move(errors.excess);
    move(errors.ideal);
    for (auto& [stratum, sizes] : errors.strata) move(sizes);
  }
}

/// Draws and judges a scene part by part.
class SceneJudge {
 public:
  SceneJudge(const cases::ClipCase& scene, backends::Backend& backend, SceneReader& reader,
             unsigned jobs)
      : scene_(&scene),
        backend_(&backend),
        reader_(&reader),
        shown_(scene.framebuffer, scene.attributes.size()) {
    options_.jobs = jobs;
  }

  /// Draws small parts first, and larger parts while drawing is quick, so that no part takes longer
  /// than a process may stay silent. The findings do not depend on where parts end.
  void judge(const PartLimits& limits) {
    constexpr std::size_t kFirst = 1024;
    constexpr double kQuick = 0.5;  // seconds
    constexpr double kSlow = 2;     // seconds
    PartLimits now = limits;
    now.triangles = std::min(limits.triangles, kFirst);
    const std::size_t count = scene_->triangles.size();
    for (std::size_t first = 0; first < count && !fault;) {
      const ScenePart part = next_part(*scene_, first, now);
      const double seconds = judge_part(part);
      if (seconds < kQuick) now.triangles = std::min(limits.triangles, 4 * now.triangles);
      if (seconds > kSlow) now.triangles = std::max<std::size_t>(now.triangles / 2, 1);
      first += part.count;
    }
  }

  cases::Fragments take_shown() { return shown_.take(); }

  /// A part that could not be drawn.
  struct Failed {
    ScenePart part;
    cases::Case source;
    Error error;
  };
  std::optional<Failed> failed;                     ///< the first of the worst kind
  std::map<std::string, std::uint64_t> not_judged;  ///< [reason] number of triangles
  records::Judgement judgement;
  std::uint64_t fragments = 0;
  std::size_t drawn = 0;  ///< parts
  std::optional<std::string> fault;

 private:
  cases::ClipCase part_of_scene(const ScenePart& part) const {
    if (part.count == scene_->triangles.size()) return *scene_;
    std::vector<std::size_t> triangles(part.count);
    std::iota(triangles.begin(), triangles.end(), part.first);
    return cases::ClipCase(with_triangles(*scene_, triangles));
  }

  /// True if the backend refuses only some triangles, rather than every case of this kind.
  bool is_of_triangles() {
    if (draws_none_) return *draws_none_;
    draws_none_ = draw(part_of_scene({0, 0}), *backend_).has_value();
    return *draws_none_;
  }

  /// Draws and judges a part, and returns the seconds that drawing took. After a crash or a hang it
  /// draws nothing more: the next part would probably fail as well, and each attempt takes long.
  double judge_part(const ScenePart& part) {
    if (gone_) {
      not_judged[cases::one_line(gone_->reason)] += part.count;
      return 0;
    }
    const cases::ClipCase source = part_of_scene(part);
    const auto start = std::chrono::steady_clock::now();
    Result<backends::Drawn> done = draw(source, *backend_);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    if (done) {
      judge_drawn_part(source, part, *done);
      return passed.count();
    }
    const bool is_split = done.error().failure == Failure::unsupported && part.count > 1 &&
                          scene_->depth_test == cases::DepthTest::none && is_of_triangles();
    if (is_split) {
      // The backend may support most of these triangles.
      const std::size_t half = part.count / 2;
      const double seconds = judge_part({part.first, half});
      return fault ? seconds : seconds + judge_part({part.first + half, part.count - half});
    }
    take_failed(Failed{part, source, done.error()});
    return passed.count();
  }

  /// Keeps the first failure; a real failure replaces an unsupported part.
  void take_failed(Failed one) {
    not_judged[cases::one_line(one.error.reason)] += one.part.count;
    if (one.error.failure == Failure::crash || one.error.failure == Failure::hang) {
      gone_ = one.error;
    }
    const bool is_worse = failed && failed->error.failure == Failure::unsupported &&
                          one.error.failure != Failure::unsupported;
    if (!failed || is_worse) failed = std::move(one);
  }

  void judge_drawn_part(const cases::ClipCase& source, const ScenePart& part,
                        const backends::Drawn& done) {
    ++drawn;
    fragments += done.fragments.size();
    const oracle::SceneTruth truth(source, done.contract);
    reader_->begin(truth, part.first);
    oracle::JudgedDrawing judged =
        oracle::judge(truth, done.fragments, options_,
                      [this](const JudgedSample& sample, const oracle::TriangleTruth* triangle) {
                        reader_->see(sample, triangle);
                      });
    if (!fault) fault = std::move(judged.fault);
    move_triangles(judged.judgement, part.first);
    records::merge(judgement, judged.judgement);
    shown_.add(done.fragments, part.first);
  }

  const cases::ClipCase* scene_;
  backends::Backend* backend_;
  SceneReader* reader_;
  ShownFragments shown_;
  oracle::JudgeOptions options_;
  std::optional<Error> gone_;       ///< the error that ended the drawing process
  std::optional<bool> draws_none_;  ///< whether the scene without triangles is drawn
};

/// Counts a failed part as a violation, unless the backend merely does not support such triangles.
void take_failure(const SceneJudge::Failed& failed, bool is_partly_drawn, Check& check) {
  Check none = failed_check(failed.error);
  if (!is_partly_drawn) {
    check = std::move(none);
  } else if (none.is_applicable) {
    check.known.clear();
    check.violation_count += none.violation_count;
  }
}

}  // namespace

Result<SceneFindings> judge_scene(const cases::Case& scene, const std::string& specification,
                                  backends::Backend& backend, std::uint64_t seed,
                                  const std::vector<std::string>& laws, unsigned jobs,
                                  const KnownDefects* known) {
  return judge_scene_in(PartLimits(), scene, specification, backend, seed, laws, jobs, known);
}

Result<SceneFindings> judge_scene_in(const PartLimits& limits, const cases::Case& scene,
                                     const std::string& specification, backends::Backend& backend,
                                     std::uint64_t seed, const std::vector<std::string>& laws,
                                     unsigned jobs, const KnownDefects* known) {
  Result<cases::ClipCase> clip = oracle::to_clip_case(scene, scene.name);
  if (!clip) return tl::unexpected(clip.error());
  SceneFindings result;
  result.source = *clip;
  NumberedCase numbered{result.source, std::string(records::kSceneStratum) + scene.name, 0,
                        records::Origin::scene};
  numbered.source.name = numbered.stratum;

  SceneReader reader(result.source, known, laws);
  SceneJudge judge(*clip, backend, reader, jobs);
  judge.judge(limits);
  result.findings.fault = judge.fault;
  result.map = reader.take_map();
  result.result = {.file = scene.name,
                   .backend = specification,
                   .triangles = result.source.triangles.size(),
                   .fragments = judge.fragments,
                   .judged = reader.judged(),
                   .open = reader.open(),
                   .wrong = reader.wrong(),
                   .is_known = reader.wrong() > 0,
                   .not_judged = judge.not_judged};
  records::Judged all;
  for (const auto& [kind, errors] : judge.judgement.errors) records::add(all, kind, errors);
  result.result.values = all.values;
  result.result.values_not_judged = std::move(all.not_judged);
  if (judge.drawn > 0) result.drawn = judge.take_shown();

  for (const Law* law : scene_laws(laws)) {
    const SceneReader::Few& few = reader.of(law->id);
    Check check;
    if (judge.drawn > 0) {
      const bool is_coverage = law->id == kCoverageLaw;
      check.judgement = is_coverage ? coverage_part(judge.judgement) : judge.judgement;
      check.violations = few.violations;
      check.violation_count = few.violations.size() + few.known.size();
      if (few.violations.empty()) check.known.assign(few.known.begin(), few.known.end());
    }
    if (judge.failed) take_failure(*judge.failed, judge.drawn > 0, check);
    if (known != nullptr) tell_expected(*known, law->id, check);
    if (!few.violations.empty() && check.known.empty()) result.result.is_known = false;
    account(*law, specification, backend, numbered, check, result.findings);
    if (judge.failed && judge.failed->error.failure != Failure::unsupported) {
      NumberedCase part{judge.failed->source, numbered.stratum, judge.failed->part.first,
                        records::Origin::scene};
      part.source.name = numbered.stratum;
      keep_counterexample(*law, specification, backend, seed, part,
                          failed_check(judge.failed->error), result.findings, known);
    }
    if (!check.known.empty()) continue;
    keep_violations(*law, specification, backend, seed, numbered, few.violations, result.findings,
                    known);
  }
  return result;
}

}  // namespace rastercheck::properties
