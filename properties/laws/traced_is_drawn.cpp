// The traced value is the drawn value: what a backend says about how a sample came about is how it
// came about. A trace that is computed beside the drawing, or recorded of another sample, explains
// an error that nobody made.
//
// Of up to four fragments of each triangle, spread over all that were drawn: there is a trace, its
// depth and attributes are the drawn ones to the bit, and its weights are what its edges give,
// E_i = a_i U + (b_i V + c_i T) with every operation rounded to double (records/stage_trace.h). Of
// samples beside them that were not drawn: there is no trace. Triangles are traced alone, so the
// depth test is left out. Judged of backends that trace.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "oracle/transform.h"
#include "properties/internal/drawn_fragments.h"
#include "properties/internal/random_state.h"
#include "properties/internal/tally.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::SampleAddress;
using records::SampleTrace;

/// Fragments of a triangle that are traced, and samples beside each of them that are asked for.
constexpr std::size_t kMostTraced = 4;

bool is_same_float(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// What is wrong with the weights of a trace; empty where nothing is.
std::string fault_of_weights(const SampleTrace& trace) {
  const records::StageTrace* edges = records::find_stage(trace, "edges");
  const records::StageTrace* weights = records::find_stage(trace, "weights");
  if (edges == nullptr || weights == nullptr) return "the trace has no edges or no weights";
  const auto u = records::find_number(weights->received, "U");
  const auto v = records::find_number(weights->received, "V");
  const auto t = records::find_number(weights->received, "T");
  for (int i = 0; i < 3; ++i) {
    const auto number = std::to_string(i);
    const auto a = records::find_number(edges->handed_on, "a" + number);
    const auto b = records::find_number(edges->handed_on, "b" + number);
    const auto c = records::find_number(edges->handed_on, "c" + number);
    const auto weight = records::find_number(weights->handed_on, "E" + number);
    if (!u || !v || !t || !a || !b || !c || !weight) return "a number of edge " + number + " lacks";
    const double expected = *a * *u + (*b * *v + *c * *t);
    if (*weight != expected) {
      return fmt::format("weight {} is {}, and its edge gives {}", i, *weight, expected);
    }
  }
  return {};
}

class TraceCheck {
 public:
  TraceCheck(const cases::Case& source, backends::Backend& backend, const cases::Framebuffer& drawn)
      : case_(&source), backend_(&backend), drawn_(&drawn), tally_(source) {}

  Result<Check> run() {
    std::map<std::uint32_t, std::vector<std::size_t>> fragments;
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      // What is not of the case is a matter of coverage.
      if (drawn_->triangle[i] < case_->triangles.size()) {
        fragments[drawn_->triangle[i]].push_back(i);
      }
    }
    for (std::uint32_t t = 0; t < case_->triangles.size() && !error_; ++t) {
      check_triangle(t, fragments[t]);
    }
    if (error_) return tl::unexpected(*error_);
    return tally_.finish();
  }

 private:
  using Place = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // y, x, sample

  SampleAddress address_of(std::size_t i) const {
    return {drawn_->triangle[i], drawn_->x[i], drawn_->y[i], drawn_->sample[i]};
  }

  void check_triangle(std::uint32_t triangle, const std::vector<std::size_t>& fragments) {
    std::set<Place> drawn;
    for (const std::size_t i : fragments) {
      drawn.emplace(drawn_->y[i], drawn_->x[i], drawn_->sample[i]);
    }
    const std::size_t count = std::min(fragments.size(), kMostTraced);
    std::set<Place> beside;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = fragments[k * fragments.size() / count];
      check_drawn(i);
      add_neighbours(address_of(i), drawn, beside);
    }
    if (fragments.empty()) beside.emplace(case_->framebuffer.height / 2, 0, 0);
    for (const auto& [y, x, sample] : beside) check_not_drawn({triangle, x, y, sample});
  }

  /// The first samples to the right, below, and behind in the pattern that were not drawn.
  void add_neighbours(const SampleAddress& at, const std::set<Place>& drawn,
                      std::set<Place>& beside) const {
    const cases::FramebufferSize& size = case_->framebuffer;
    const auto walk = [&](std::uint32_t dx, std::uint32_t dy, std::uint32_t ds) {
      std::uint32_t x = at.x;
      std::uint32_t y = at.y;
      std::uint32_t s = at.sample;
      while (std::cmp_less(x, size.width) && std::cmp_less(y, size.height) &&
             std::cmp_less(s, size.samples)) {
        if (!drawn.contains({y, x, s})) {
          beside.emplace(y, x, s);
          return;
        }
        x += dx;
        y += dy;
        s += ds;
      }
    };
    walk(1, 0, 0);
    walk(0, 1, 0);
    walk(0, 0, 1);
  }

  std::optional<SampleTrace> trace_of(const SampleAddress& at) {
    if (error_) return std::nullopt;
    Result<std::optional<SampleTrace>> trace = backend_->trace(*case_, at);
    if (trace) return *std::move(trace);
    error_ = trace.error();
    return std::nullopt;
  }

  void check_drawn(std::size_t i) {
    const SampleAddress at = address_of(i);
    const std::optional<SampleTrace> trace = trace_of(at);
    if (error_) return;
    ++tally_.counts().required;
    tally_.see(at.triangle);
    if (!trace) return report(at, FragmentClass::missing, "drawn", "no trace");
    tally_.pass(AttributeKind::coverage);
    check_value(at, AttributeKind::depth, std::nullopt, drawn_->depth[i], trace->depth);
    const auto drawn = drawn_->attributes_of(i);
    if (trace->attributes.size() != drawn.size()) {
      note_fault(at, "the trace has another number of attributes");
    } else {
      for (std::uint32_t a = 0; a < drawn.size(); ++a) {
        check_value(at, records::kind_of(case_->attributes[a].interpolation), a, drawn[a],
                    trace->attributes[a]);
      }
    }
    if (const std::string fault = fault_of_weights(*trace); !fault.empty()) note_fault(at, fault);
    add_labels(*trace);
  }

  void check_not_drawn(const SampleAddress& at) {
    const std::optional<SampleTrace> trace = trace_of(at);
    if (error_) return;
    ++tally_.counts().forbidden;
    tally_.label("not drawn");
    if (trace) report(at, FragmentClass::extra, "not drawn", "a trace");
  }

  void check_value(const SampleAddress& at, AttributeKind kind,
                   std::optional<std::uint32_t> attribute, float drawn, float traced) {
    if (is_same_float(drawn, traced)) return tally_.pass(kind);
    tally_.report(violation_at(place_of(at), FragmentClass::beyond_bound, value_text(drawn),
                               "the trace has another value than the drawing",
                               {kind, attribute, traced}));
  }

  void note_fault(const SampleAddress& at, const std::string& fault) {
    report(at, FragmentClass::beyond_bound, "a trace that holds together", "a trace", fault);
  }

  /// How the sample was decided, and that values needed more than double.
  void add_labels(const SampleTrace& trace) {
    if (const records::StageTrace* coverage = records::find_stage(trace, "coverage")) {
      for (const records::NamedNumber& decision : coverage->handed_on) {
        tally_.label("decided " + decision.name);
      }
    }
    if (const records::StageTrace* evaluation = records::find_stage(trace, "evaluation")) {
      for (const records::NamedNumber& number : evaluation->handed_on) {
        if (number.name.ends_with("_is_exact") && number.value != 0) tally_.label("exact value");
        if (number.name.ends_with("_u")) tally_.label("located elsewhere");
      }
    }
  }

  static FragmentPlace place_of(const SampleAddress& at) {
    return {at.triangle, at.y, at.x, at.sample};
  }

  void report(const SampleAddress& at, FragmentClass found, const char* exact, const char* actual,
              const std::string& note = "") {
    records::Violation violation = violation_at(place_of(at), found, exact, note);
    violation.actual = actual;
    tally_.report(violation);
  }

  const cases::Case* case_;
  backends::Backend* backend_;
  const cases::Framebuffer* drawn_;
  Tally tally_;
  std::optional<Error> error_;
};

Result<Check> check(const cases::Case& c, backends::Backend& backend,
                    const CheckOptions& /*options*/) {
  Result<cases::Case> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  if (!backend.traces()) return not_applicable();
  clip->depth_test = cases::DepthTest::none;
  const Result<cases::Framebuffer> drawn = draw(*clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return TraceCheck(*clip, backend, *drawn).run();
}

bool is_promised(const backends::Backend& backend) { return backend.traces(); }

/// Any case, in half of them with snapped vertices.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  if (draw.one_in(2)) set_snapped_coverage(draw, made.source);
  return made;
}

const LawRegistration kRegistration(
    {.name = "the traced value is the drawn value",
     .reason = "A trace says how the drawn value came about, so that its parts are the drawn ones.",
     .exceptions = "backends that do not trace",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not trace",
     .covers = {cover(13, "clipped"), cover_decided(14, "decided in_double"),
                cover_decided(27, "decided in_whole_numbers"), cover_decided(9, "exact value"),
                cover(8, "located elsewhere"), cover(48, "not drawn"), cover(16, "several samples"),
                cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties
