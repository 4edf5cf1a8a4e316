// Measures the grid, whether it is the one asked for, and the position error.
//
// Contracts state a position error if the drawings of grid.h do not agree with a grid for all
// samples, or if contracts have no name for the measured rounding. The error says how far positions
// may be off before they are rounded; the measured error is the least under which the judge finds
// nothing wrong. It is measured from two sorts of drawings: those of grid.h, and others whose
// positions a float32 viewport transform has to round. The latter lie near the middle between two
// grid points, where a small error shows as a whole unit.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cases/names.h"
#include "properties/probing/measures.h"
#include "properties/random_floats.h"

namespace rastercheck::properties {
namespace {

using cases::Rounding;
using cases::Snapping;

Rounding named(GridRounding rounding) {
  switch (rounding) {
    case GridRounding::nearest_even:
      return Rounding::nearest_even;
    case GridRounding::half_up:
      return Rounding::half_up;
    case GridRounding::half_down:
      return Rounding::half_down;
    case GridRounding::down:
      return Rounding::floor;
    case GridRounding::up:
      break;
  }
  return Rounding::ceil;
}

/// Returns the grid in a contract's terms, with `unspecified` if positions are moved before they
/// are rounded, which no contract can say.
Snapping named(const MeasuredGrid& grid) {
  if (grid.is_none()) return {cases::kMaxSubpixelBits, Rounding::unspecified, 0};
  if (grid.is_moved()) return {grid.bits, Rounding::unspecified, 0};
  Snapping snapping{grid.bits, named(grid.x), 0, {}, grid.odd_steps};
  if (grid.y != grid.x) snapping.rounding_of_y = named(grid.y);
  return snapping;
}

/// True if drawings on the measured grid break the declared coverage. If the declared coverage has
/// a position error, nothing is a contradiction here: the error may explain the difference, and is
/// measured separately.
bool contradicts(const cases::Coverage& declared, const GridFit& fit) {
  const MeasuredGrid& grid = fit.grid;
  if (fit.samples == 0) return false;
  if (!declared) return !grid.is_none() || !fit.is_explained || grid.is_moved();
  if (declared->position_error > 0) return false;
  const Snapping measured = named(grid);
  if (grid.is_none() || measured.steps() != declared->steps()) return true;
  if (declared->is_unspecified()) return false;
  return measured.rounding_along(0) != declared->rounding_along(0) ||
         measured.rounding_along(1) != declared->rounding_along(1);
}

std::string declared_of(const cases::Coverage& coverage) {
  if (!coverage) return "none: exact";
  std::string text = coverage->odd_steps == 1 ? fmt::format("{} bits", coverage->subpixel_bits)
                                              : fmt::format("1/{} pixel", coverage->steps());
  text += fmt::format(", {}", name_of(coverage->rounding));
  if (coverage->rounding_of_y) text += fmt::format(" (y {})", name_of(*coverage->rounding_of_y));
  if (coverage->position_error > 0) text += fmt::format(" ± {:.2g}", coverage->position_error);
  return text;
}

/// Draws triangles with an edge that has one end within a few floats of the middle between grid
/// points. Viewports have odd sizes, and vertices several values of w. In some cases the
/// end lies exactly in the middle, and only the division by w has something to round.
std::vector<DrawnCase> draw_inexact(Subject& subject, int steps, float size) {
  constexpr int kCases = 6;
  constexpr int kTriangles = 48;
  std::vector<DrawnCase> all;
  const double unit = 1.0 / steps;
  const cases::PixelFraction& sample = subject.sample();
  for (std::uint64_t i = 0; i < kCases; ++i) {
    MeasureDraw draw(subject, fmt::format("position error {}", size), i);
    cases::Case c = subject.base();
    const bool is_exact = size == 64 && i % 2 == 0;
    const auto beside = [&] { return is_exact ? 0.0F : static_cast<float>(draw.between(-3, 3)); };
    c.viewport.width = size + 0.25F * beside();
    c.viewport.height = size + 0.25F * beside();
    // The framebuffer shows the far corner of a large viewport: coordinates are greatest there, and
    // the drawing stays small.
    c.viewport.x = size > 64 ? std::floor(64 - c.viewport.width) : 0.0F;
    c.viewport.y = size > 64 ? std::floor(64 - c.viewport.height) : 0.0F;
    for (int k = 0; k < kTriangles; ++k) {
      const double sample_x = draw.between(20, 43) + static_cast<double>(sample.x) / sample.parts;
      const double sample_y = draw.between(20, 43) + static_cast<double>(sample.y) / sample.parts;
      const int along_x = draw.between(-4, 4);
      const int along_y = along_x == 0 ? draw.between(1, 4) : draw.between(-4, 4);
      const double off_x = (draw.between(-1, 1) + 0.5) * unit;
      const double off_y = (draw.between(-1, 1) + 0.5) * unit;
      const auto weight = [&] {
        return is_exact ? draw.pick(std::array{3.0F, 5.0F, 7.0F, 11.0F}) : draw.uniform(0.5F, 4);
      };
      const float w0 = weight();
      const float w1 = weight();
      const WindowPoint a{sample_x + along_x + off_x, sample_y + along_y + off_y};
      const WindowPoint b{sample_x - 2.0 * along_x, sample_y - 2.0 * along_y};
      const WindowPoint d{sample_x - 4.0 * along_y, sample_y + 4.0 * along_x};
      const cases::ClipVertex first = at_window(c, a, 0.5F, w0);
      const cases::ClipVertex second = at_window(c, b, 0.5F, w1);
      add_triangle(c, first, second, at_window(c, d, 0.5F, 1));
    }
    if (auto drawn = subject.drawn(std::move(c))) all.push_back(*std::move(drawn));
  }
  return all;
}

/// Returns `from`, then ever wider combinations of rounding and position error. The last are of
/// whole pixels, for positions that no finer grid's errors can explain.
std::vector<Snapping> ladder_from(const Snapping& from) {
  std::vector<Snapping> ladder{from};
  const auto add = [&ladder, &from](Rounding rounding, float error) {
    const bool is_named = rounding != Rounding::unspecified;
    ladder.push_back({from.subpixel_bits, rounding, error,
                      is_named ? from.rounding_of_y : std::nullopt, from.odd_steps});
  };
  if (from.rounding != Rounding::unspecified) {
    for (int e = -28; e <= -2; e += e < -14 ? 4 : 1) add(from.rounding, std::ldexp(1.0F, e));
    add(Rounding::unspecified, 0);
  }
  for (int e = -2; e <= 12; ++e) add(Rounding::unspecified, std::ldexp(1.0F, e));
  for (int e = 0; e <= 16; ++e) {
    const float pixels = std::ldexp(1.0F, e);
    if (pixels * static_cast<float>(from.steps()) <= 0x1p12F) continue;
    ladder.push_back({0, Rounding::unspecified, pixels});
  }
  return ladder;
}

/// Returns the first step of the ladder with which the drawings hold; empty if none does.
std::optional<Snapping> least_holding(const Subject& subject, const std::vector<DrawnCase>& drawn,
                                      const Snapping& from) {
  cases::ContractTerms terms = subject.result.terms;
  terms.tie_rule = cases::TieRule::unspecified;  // not measured yet
  terms.is_on_grid = from.rounding != Rounding::unspecified;
  const std::vector<Snapping> ladder = ladder_from(from);
  const auto holds = [&](const Snapping& snapping) {
    terms.coverage = cases::Coverage(snapping);
    return subject.holds(drawn, terms);
  };
  if (holds(from)) return from;
  const auto least = std::partition_point(ladder.begin() + 1, ladder.end(),
                                          [&](const Snapping& one) { return !holds(one); });
  if (least == ladder.end()) return std::nullopt;
  return *least;
}

std::string snapping_text(const std::optional<Snapping>& snapping) {
  if (!snapping) return "more than 65536 pixels";
  if (snapping->rounding == Rounding::unspecified) {
    const double units = 1 + double{snapping->position_error};
    if (snapping->steps() == 1) {
      return fmt::format("less than {:g} pixels, rounding included", units);
    }
    return fmt::format("less than {:g} grid units, rounding included", units);
  }
  if (snapping->position_error == 0) return "none";
  return fmt::format("{:.3g} grid units", snapping->position_error);
}

/// Returns the snapping that moves positions farther.
Snapping wider_of(const Snapping& a, const Snapping& b) {
  const auto size = [](const Snapping& s) {
    const double units = double{s.position_error} + (s.is_unspecified() ? 0.5 : 0);
    return units / s.steps();
  };
  return size(a) >= size(b) ? a : b;
}

/// Returns the smallest position error that a contract may state, in grid units: drawings do not
/// show errors below a step of the float32 positions that they were made of, which is 2^-18 pixels
/// at most in the window. The declared error is better known, if the grid is the declared one.
float unseen_error(const Subject& subject, const Snapping& measured) {
  const cases::Coverage declared = subject.declared().coverage;
  if (declared && declared->steps() == measured.steps()) return declared->position_error;
  return std::ldexp(static_cast<float>(measured.steps()), -18);
}

/// Measures the position error, both in a small window and far from the origin of a large viewport.
void measure_position_error(Subject& subject, const Sight& sight) {
  const Snapping grid = named(sight.fit.grid);
  std::vector<DrawnCase> exact;
  exact.reserve(sight.drawings.size());
  for (const FineDrawing& one : sight.drawings) exact.push_back(one.drawn);
  const std::array<std::pair<std::string, std::vector<DrawnCase>>, 3> sorts{
      {{"of positions that floats can represent", exact},
       {"of others, 64 pixels", draw_inexact(subject, grid.steps(), 64)},
       {"of others, viewport of 8192", draw_inexact(subject, grid.steps(), 8192)}}};
  const bool is_exact = sight.fit.grid.is_none() && sight.fit.mismatches == 0 &&
                        !sight.fit.grid.is_moved() && !subject.declared().coverage;
  cases::ContractTerms& terms = subject.result.terms;
  if (is_exact) {
    terms.coverage = cases::Coverage();
    terms.tie_rule = cases::TieRule::unspecified;
    CoverageTally tally;
    records::Sureness sureness = sure_of("cases", 0);
    for (const auto& [name, drawn] : sorts) {
      tally += subject.tally(drawn, terms);
      sureness.in_favour += drawn.size();
    }
    if (tally.holds()) {
      subject.add("position error", kNotDeclared, "none", "", sureness);
      return;
    }
  }
  Snapping widest = grid;
  bool is_bounded = true;
  for (const auto& [name, drawn] : sorts) {
    if (drawn.empty()) {
      subject.add("position error", kNotDeclared, "not drawn", name);
      continue;
    }
    const std::optional<Snapping> least = least_holding(subject, drawn, grid);
    const auto holding = least ? drawn.size() : 0;
    subject.add("position error", kNotDeclared, snapping_text(least), name,
                sure_of("cases", holding, drawn.size() - holding));
    is_bounded = is_bounded && least;
    if (least) widest = wider_of(least.value(), widest);
  }
  if (!is_bounded) widest = {0, Rounding::unspecified, cases::kMaxPositionError};
  widest.position_error = std::max(widest.position_error, unseen_error(subject, widest));
  terms.coverage = cases::Coverage(widest);
  const bool is_named = !widest.is_unspecified() || !sight.fit.grid.is_none();
  terms.is_on_grid = is_named && widest.steps() == grid.steps();
}

/// For a backend that rounds to the grid asked for: measures which grids it follows, and whether it
/// follows the rounding asked for. If it follows all grids, the coverage term says so, with the
/// case's rounding if that is followed, else with the measured one. If the backend does not follow
/// all grids, the term stays empty, so that the backend's own promise holds.
void measure_what_is_followed(Subject& subject, AskedDrawing asked) {
  const AskedDrawing as_before = asked;
  const cases::Coverage measured = subject.contract(subject.base()).coverage;
  const auto grid_asked = [&](const Snapping& snapping) {
    asked.coverage = cases::Coverage(snapping);
    subject.ask(asked);
    return fit_grid(subject, draw_grid_cases(subject));
  };
  std::string others;
  int honoured = 0;
  for (int bits = 0; bits <= cases::kMaxSubpixelBits; ++bits) {
    const MeasuredGrid drawn = grid_asked({bits, Rounding::nearest_even, 0}).grid;
    const bool is_honoured = drawn.steps() == 1 << bits;
    honoured += is_honoured ? 1 : 0;
    if (is_honoured) continue;
    const std::string instead = drawn.odd_steps == 1 ? std::to_string(drawn.bits)
                                                     : fmt::format("1/{} pixel", drawn.steps());
    others += fmt::format("{}{} instead of {}", others.empty() ? "" : ", ", instead, bits);
  }
  subject.add("bits requested", kNotDeclared,
              others.empty() ? "0 to 16, all honoured" : "0 to 16, except " + others, "",
              sure_of("grids", honoured, cases::kMaxSubpixelBits + 1 - honoured));
  const GridFit half_up = grid_asked({kAskedBits, Rounding::half_up, 0});
  const cases::Coverage declared = subject.declared().coverage;
  subject
      .add("grid if half_up is requested", declared_of(declared), to_string(half_up), "",
           sureness_of(half_up))
      .contradicts = contradicts(declared, half_up);
  subject.ask(as_before);

  cases::ContractTerms& terms = subject.result.terms;
  const bool is_named = measured && measured->steps() == 1 << kAskedBits;
  const float declared_error = declared ? declared->position_error : 0;
  terms.coverage.reset();
  if (!is_named || !others.empty()) {
    terms.is_on_grid.reset();
    return;
  }
  const bool follows_rounding =
      measured->rounding == Rounding::nearest_even && half_up.grid.steps() == 1 << kAskedBits &&
      half_up.grid.x == GridRounding::half_up && half_up.grid.y == GridRounding::half_up;
  if (!follows_rounding) {
    terms.coverage = cases::AskedGrid{measured->rounding, measured->position_error};
  } else if (measured->position_error == 0) {
    terms.coverage = cases::AsAsked{};
  } else if (measured->position_error > declared_error) {
    // No term says "as asked, with this error".
    terms.coverage = cases::AskedGrid{Rounding::unspecified, measured->position_error};
  } else {
    terms.coverage.reset();  // the backend's own promise has this error
  }
}

/// Adds a row for the samples' position, if it was seen. Later measures draw about it.
void measure_sample_position(Subject& subject, const GridFit& fit) {
  if (fit.samples == 0 || !fit.is_explained) return;
  const cases::PixelFraction declared = subject.sample();
  const cases::PixelFraction& measured = fit.grid.sample;
  const auto text = [](const cases::PixelFraction& at) {
    return fmt::format("({}/{}, {}/{})", at.x, at.parts, at.y, at.parts);
  };
  const bool is_another = measured != declared;
  subject.add("sample position", text(declared), text(measured), "", sureness_of(fit)).contradicts =
      is_another;
  if (!is_another) return;
  subject.set_sample(measured);
  subject.result.terms.sample_position = measured;
}

/// For a backend that declares conservative coverage: finds the error with which it is kept. False
/// if that is more than half a pixel beyond the declared one, so that the backend must be taken to
/// cover samples.
bool keeps_conservative(Subject& subject, const std::vector<FineDrawing>& drawings) {
  const cases::Conservative declared = *subject.declared().conservative;
  if (drawings.empty()) {
    subject.add("conservative coverage", kNotDeclared, "not drawn");
    return true;
  }
  cases::ContractTerms& terms = subject.result.terms;
  std::vector<DrawnCase> drawn;
  drawn.reserve(drawings.size());
  for (const FineDrawing& one : drawings) drawn.push_back(one.drawn);
  const auto text = [](const cases::Conservative& one) {
    const bool is_outer = one.kind == cases::ConservativeKind::outer;
    return fmt::format("{}, off by {:.2g} pixels at most", is_outer ? "outer" : "inner", one.error);
  };
  cases::Conservative measured = declared;
  constexpr int kLeast = -16;
  constexpr int kMost = -1;
  for (int e = kLeast - 1; e <= kMost && !subject.is_time_up(); ++e) {
    if (e >= kLeast) measured.error = declared.error + std::ldexp(1.0F, e);
    terms.conservative = measured;
    if (!subject.holds(drawn, terms)) continue;
    subject
        .add("conservative coverage", text(declared), text(measured), "",
             sure_of("cases", drawn.size()))
        .contradicts = measured != declared;
    if (measured == declared) terms.conservative.reset();
    return true;
  }
  terms.conservative = std::optional<cases::Conservative>();
  subject.add("conservative coverage", text(declared), "not kept", "", sure_of("cases", 0, 1))
      .contradicts = true;
  return false;
}

}  // namespace

void measure_grid(Subject& subject, Sight& sight) {
  // Conservative drawings show no samples, so the declared grid and tie rule stand.
  sight.is_conservative = subject.declared().conservative.has_value() &&
                          keeps_conservative(subject, draw_grid_cases(subject));
  if (sight.is_conservative) return;
  const AskedDrawing said = subject.asked();
  AskedDrawing asked = said;
  if (!said.coverage) {
    asked.coverage = cases::Coverage();
    subject.ask(asked);
  }
  sight.drawings = draw_grid_cases(subject);
  sight.fit = fit_grid(subject, sight.drawings);
  const GridFit unasked = sight.fit;
  const cases::Coverage declared = subject.declared().coverage;
  if (!said.coverage) {
    asked.coverage = cases::Coverage(Snapping{kAskedBits - 1, Rounding::nearest_even, 0});
    subject.ask(asked);
    const MeasuredGrid odd = fit_grid(subject, draw_grid_cases(subject)).grid;
    sight.follows_coverage = odd.steps() == 1 << (kAskedBits - 1) && odd != unasked.grid;
  }
  if (sight.follows_coverage) {
    asked.coverage = cases::Coverage(Snapping{kAskedBits, Rounding::nearest_even, 0});
    subject.ask(asked);
    sight.drawings = draw_grid_cases(subject);
    sight.fit = fit_grid(subject, sight.drawings);
    subject
        .add("grid if exact is requested", declared_of(declared), to_string(unasked), "",
             sureness_of(unasked))
        .contradicts = contradicts(declared, unasked);
  } else {
    subject.ask(said);
  }
  const GridFit& fit = sight.fit;
  const cases::Coverage on = subject.declared().coverage;
  const std::string what = sight.follows_coverage
                               ? fmt::format("grid if {} bits are requested", kAskedBits)
                               : "subpixel grid";
  const std::string detail =
      fit.mismatches == 0 ? ""
                          : fmt::format("drawn otherwise by up to {:.2g} pixels", fit.farthest);
  subject.add(what, declared_of(on), to_string(fit), detail, sureness_of(fit)).contradicts =
      contradicts(on, fit);
  if (sight.drawings.empty()) return;
  measure_sample_position(subject, fit);
  measure_position_error(subject, sight);
  if (sight.follows_coverage) measure_what_is_followed(subject, asked);
}

}  // namespace rastercheck::properties
