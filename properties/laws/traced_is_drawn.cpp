// The traced value is the drawn value: a backend's trace of a sample describes how the sample was
// really computed. A trace computed beside the drawing, or recorded for another sample, explains an
// error that does not exist.
//
// The law checks up to four fragments of each triangle, spread over all its drawn fragments. A
// trace must exist, its depth and attributes must equal the drawn ones to the bit, and the trace
// must be consistent. Its lines must give the traced weights, both at the sample and where a value
// is evaluated; its planes, if any, must give a value's numerator and denominator. For lines and
// planes, every operation is rounded to double (records/stage_trace.h). The evaluated result rounds
// to the value. If a neighbouring sample that was not drawn has a trace, the trace must say that
// the sample was not drawn, and the trace's lines must give the trace's weights. Triangles are
// traced one by one, so the depth test is removed. Only backends that trace are judged.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/random_state.h"

namespace rastercheck::properties::traced_is_drawn_law {
namespace {

using cases::SamplePlace;
using records::AttributeKind;
using records::FragmentClass;
using records::SampleTrace;
using records::TracedValue;

/// The greatest number of fragments of a triangle that are traced.
constexpr std::size_t kMostTraced = 4;

bool is_same_float(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

double on_axis(const records::TracedAxis& axis, double at) {
  return axis.scale * (2 * at - axis.shift);
}

/// The value of a line or a plane at (u, v); `c` is its constant.
template <typename Plane>
double value_at(const Plane& plane, const records::TracedFrame& frame, double c, double u,
                double v) {
  return plane.a * on_axis(frame.u, u) + (plane.b * on_axis(frame.v, v) + c);
}

using Weights = std::array<double, 3>;

/// Returns what is wrong with the weights at (u, v); empty if they are right.
std::string fault_of_weights(const SampleTrace& trace, const Weights& weights, double u, double v) {
  if (!trace.lines || !trace.frame) return "the trace has weights but no lines";
  for (std::size_t i = 0; i < 3; ++i) {
    const records::TracedLine& line = (*trace.lines)[i];
    const double expected = value_at(line, *trace.frame, line.c * trace.frame->t, u, v);
    if (weights[i] != expected) {
      return fmt::format("weight {} is {}, but its line gives {}", i, weights[i], expected);
    }
  }
  return {};
}

std::string fault_of_weights(const SampleTrace& trace) {
  if (!trace.edges) return trace.lines ? "the trace has lines but no weights" : "";
  return fault_of_weights(trace, *trace.edges, trace.u, trace.v);
}

std::string fault_of_plane(const SampleTrace& trace, const TracedValue& value,
                           const std::optional<records::TracedPlane>& plane,
                           const std::optional<double>& at) {
  if (!plane && !at) return {};
  if (!plane || !at || !trace.frame) return "a plane, its value or its frame is missing";
  const double expected = value_at(*plane, *trace.frame, plane->c, value.u, value.v);
  if (*at == expected) return {};
  return fmt::format("a plane is traced as {}, but evaluates to {}", *at, expected);
}

std::string fault_of_value(const SampleTrace& trace, const TracedValue& value) {
  std::string fault = fault_of_plane(trace, value, value.numerator, value.numerator_at);
  if (fault.empty()) {
    fault = fault_of_plane(trace, value, value.denominator, value.denominator_at);
  }
  if (fault.empty() && value.is_from_lines && value.weights) {
    fault = fault_of_weights(trace, *value.weights, value.u, value.v);
  }
  if (!fault.empty() || !value.evaluated) return fault;
  const auto rounded = static_cast<float>(*value.evaluated);
  if (is_same_float(rounded, value.value)) return {};
  return fmt::format("{} is rounded to {}", *value.evaluated, value.value);
}

class TraceCheck {
 public:
  TraceCheck(const cases::Case& source, backends::Backend& backend, const cases::Fragments& drawn)
      : case_(&source), backend_(&backend), drawn_(&drawn), tally_(source) {}

  Result<Check> run() {
    std::map<std::uint32_t, std::vector<std::size_t>> fragments;
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      // Fragments outside the case are left to laws about coverage.
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
  using Places = std::set<cases::SamplePlace>;

  void check_triangle(std::uint32_t triangle, const std::vector<std::size_t>& fragments) {
    Places drawn;
    for (const std::size_t i : fragments) drawn.insert(drawn_->place_of(i));
    const std::size_t count = std::min(fragments.size(), kMostTraced);
    Places beside;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = fragments[k * fragments.size() / count];
      check_drawn(i);
      add_neighbours(drawn_->place_of(i), drawn, beside);
    }
    if (fragments.empty()) {
      cases::SamplePlace middle;
      middle.triangle = triangle;
      middle.y = static_cast<std::uint32_t>(case_->framebuffer.height / 2);
      beside.insert(middle);
    }
    for (const cases::SamplePlace& at : beside) check_not_drawn(at);
  }

  /// Adds the nearest undrawn samples: to the right, below, and later in the pattern.
  void add_neighbours(const cases::SamplePlace& at, const Places& drawn, Places& beside) const {
    for (std::uint32_t cases::SamplePlace::*const towards :
         {&cases::SamplePlace::x, &cases::SamplePlace::y, &cases::SamplePlace::sample}) {
      cases::SamplePlace next = at;
      while (is_of_case(*case_, next) && drawn.contains(next)) ++(next.*towards);
      if (is_of_case(*case_, next)) beside.insert(next);
    }
  }

  std::optional<SampleTrace> trace_of(const cases::SamplePlace& at) {
    if (error_) return std::nullopt;
    Result<std::optional<SampleTrace>> trace = backend_->tracer()->trace(*case_, at);
    if (trace) return *std::move(trace);
    error_ = trace.error();
    return std::nullopt;
  }

  void check_drawn(std::size_t i) {
    const cases::SamplePlace at = drawn_->place_of(i);
    const std::optional<SampleTrace> trace = trace_of(at);
    if (error_) return;
    ++tally_.counts().required;
    tally_.see(at.triangle);
    if (!trace) return report(at, FragmentClass::missing, "drawn", "no trace");
    if (!trace->is_drawn) return report(at, FragmentClass::missing, "drawn", "not drawn");
    tally_.pass(AttributeKind::coverage);
    note_fault(at, fault_of_weights(*trace));
    tally_.label("decided " + trace->decision);
    check_value(at, AttributeKind::depth, std::nullopt, drawn_->depth[i], *trace, trace->depth);
    const auto drawn = drawn_->attributes_of(i);
    if (trace->attributes.size() != drawn.size()) {
      return note_fault(at, "the trace has another number of attributes than the case");
    }
    for (std::uint32_t a = 0; a < drawn.size(); ++a) {
      check_value(at, records::kind_of(case_->attributes[a].interpolation), a, drawn[a], *trace,
                  trace->attributes[a]);
    }
  }

  void check_not_drawn(const cases::SamplePlace& at) {
    const std::optional<SampleTrace> trace = trace_of(at);
    if (error_) return;
    ++tally_.counts().forbidden;
    tally_.label("not drawn");
    if (!trace) return;
    if (trace->is_drawn) return report(at, FragmentClass::extra, "not drawn", "a trace");
    note_fault(at, fault_of_weights(*trace));
  }

  void check_value(const cases::SamplePlace& at, AttributeKind kind,
                   std::optional<std::uint32_t> attribute, float drawn, const SampleTrace& trace,
                   const TracedValue& traced) {
    if (traced.is_exact) tally_.label("exact value");
    if (traced.u != trace.u || traced.v != trace.v) tally_.label("located elsewhere");
    if (!is_same_float(drawn, traced.value)) {
      return tally_.report(violation_at(at, FragmentClass::beyond_bound, value_text(drawn),
                                        "the trace has another value than the drawing",
                                        {kind, attribute, traced.value}));
    }
    tally_.pass(kind);
    note_fault(at, fault_of_value(trace, traced));
  }

  void note_fault(const cases::SamplePlace& at, const std::string& fault) {
    if (fault.empty()) return;
    report(at, FragmentClass::beyond_bound, "a consistent trace", "a trace", fault);
  }

  void report(const cases::SamplePlace& at, FragmentClass found, const char* exact,
              const char* actual, const std::string& note = "") {
    records::Violation violation = violation_at(at, found, exact, note);
    violation.actual = actual;
    tally_.report(violation);
  }

  const cases::Case* case_;
  backends::Backend* backend_;
  const cases::Fragments* drawn_;
  Tally tally_;
  std::optional<Error> error_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  if (backend.tracer() == nullptr) return not_applicable("the backend does not trace");
  clip.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return TraceCheck(clip, backend, drawn->fragments).run();
}

bool is_promised(backends::Backend& backend) { return backend.tracer() != nullptr; }

/// Makes any case; half of the cases have snapped vertices.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  if (draw.one_in(2)) set_snapped_coverage(draw, made.source);
  return made;
}

const LawRegistration kRegistration(
    {.id = "the-traced-value-is-the-drawn-value",
     .sentence = "the traced value is the drawn value",
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
}  // namespace rastercheck::properties::traced_is_drawn_law
