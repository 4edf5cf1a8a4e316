// Measures whether attributes, depth and facing come from the given positions or from those on the
// grid.
//
// Draws small triangles with vertices nearly half a grid unit off the grid. Computes their values
// at a sample in double for both positions (w = 1, so linear in the window). The share
//
//   (drawn − ideal) / (snapped − ideal)
//
// is near 0 if values come from the given positions, and near 1 if they come from the snapped ones.
// For facing, draws thin triangles whose orientation is reversed by rounding, with either face
// culled.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/names.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using cases::Basis;

/// Counts samples by their share: near 0 (ideal), near 1 (snapped), and all.
struct Shares {
  int ideal = 0;
  int snapped = 0;
  int all = 0;
  int too_near = 0;  ///< samples whose two values are too near each other to tell

  void add(double value, double ideal_value, double snapped_value) {
    // The two values must differ by at least this much, or rounding of values hides the effect of
    // positions.
    if (std::abs(snapped_value - ideal_value) < 0x1p-20) {
      ++too_near;
      return;
    }
    const double share = (value - ideal_value) / (snapped_value - ideal_value);
    ++all;
    ideal += std::abs(share) < 0.25 ? 1 : 0;
    snapped += std::abs(share - 1) < 0.25 ? 1 : 0;
  }

  /// Empty if no sample was counted.
  std::optional<Basis> basis() const {
    if (all == 0) return std::nullopt;
    if (10 * ideal >= 9 * all) return Basis::ideal;
    if (10 * snapped >= 9 * all) return Basis::snapped;
    return Basis::unspecified;
  }
  std::string text() const {
    const auto found = basis();
    if (!found) return "not seen";
    return *found == Basis::unspecified ? "neither" : std::string(name_of(*found));
  }
  std::string detail() const {
    if (all == std::max(ideal, snapped)) return "";
    return fmt::format("{} ideal, {} snapped", ideal, snapped);
  }
  /// Counts for the basis found, or for either if neither was.
  records::Sureness sureness(const char* unit) const {
    const auto found = basis();
    const int in_favour = !found                     ? 0
                          : *found == Basis::ideal   ? ideal
                          : *found == Basis::snapped ? snapped
                                                     : all - std::max(ideal, snapped);
    return sure_of(unit, in_favour, all - in_favour, too_near);
  }
};

/// Returns the value at a sample of a function that is linear in the window.
double fine_value_at(const FineTriangle& t, const std::array<float, 3>& values, int x, int y) {
  const auto pixels = [&t](std::int64_t units) {
    return static_cast<double>(units) / static_cast<double>(t.scale.pixel);
  };
  const double u = x + pixels(t.scale.sample_x - t.x[0]);
  const double v = y + pixels(t.scale.sample_y - t.y[0]);
  const double u1 = pixels(t.x[1] - t.x[0]);
  const double v1 = pixels(t.y[1] - t.y[0]);
  const double u2 = pixels(t.x[2] - t.x[0]);
  const double v2 = pixels(t.y[2] - t.y[0]);
  const double area = u1 * v2 - v1 * u2;
  const double s = (u * v2 - v * u2) / area;
  const double r = (u1 * v - v1 * u) / area;
  return double{values[0]} + s * (double{values[1]} - double{values[0]}) +
         r * (double{values[2]} - double{values[0]});
}

/// Triangles of about 8 pixels, off the grid by 0.3 to 0.5 units; values and depths from 0 to 1.
struct OffGrid {
  cases::Case source;
  std::vector<FineTriangle> triangles;
  std::vector<std::array<float, 3>> values;
};

OffGrid off_grid(const Subject& subject, int steps, bool has_noperspective, std::uint64_t index) {
  constexpr int kTriangles = 32;
  MeasureDraw draw(subject, "basis", index);
  OffGrid all{subject.base(), {}, {}};
  cases::Case& c = all.source;
  c.attributes.push_back({"smooth"});
  if (has_noperspective) {
    c.attributes.push_back({"noperspective", cases::Interpolation::noperspective});
  }
  const std::int64_t unit = kFinePixel / steps;
  for (int i = 0; i < kTriangles; ++i) {
    FineTriangle t;
    t.scale = scale_of(subject.sample());
    std::array<float, 3> values{};
    const int x = draw.between(8, 48);
    const int y = draw.between(8, 48);
    for (std::size_t k = 0; k < 3; ++k) {
      const int corner_x = k == 1 ? 7 : draw.between(0, 2);
      const int corner_y = k == 2 ? 7 : draw.between(0, 2);
      const auto off = [&] {
        return unit * draw.between(30, 49) / 100 * (draw.one_in(2) ? 1 : -1);
      };
      t.x[k] = (std::int64_t{x + corner_x} << kFineBits) + off();
      t.y[k] = (std::int64_t{y + corner_y} << kFineBits) + off();
      values[k] = draw.unit();
      add_vertex(c, fine_vertex(c, t.x[k], t.y[k], values[k]));
      for (std::size_t a = 0; a < c.attributes.size(); ++a) c.attribute_values.push_back(values[k]);
    }
    const auto end = static_cast<std::uint32_t>(c.positions.size());
    c.triangles.push_back({end - 3, end - 2, end - 1});
    all.triangles.push_back(t);
    all.values.push_back(values);
  }
  return all;
}

/// Returns the window depths that belong to these values of z/w.
std::array<float, 3> depths_of(const cases::Case& c, const std::array<float, 3>& values) {
  if (c.rules != cases::Rules::opengl) return values;
  std::array<float, 3> depths{};
  std::transform(values.begin(), values.end(), depths.begin(), [](float z) { return (z + 1) / 2; });
  return depths;
}

struct ValueShares {
  Shares smooth;
  Shares noperspective;
  Shares depth;
};

ValueShares value_shares(Subject& subject, const MeasuredGrid& grid) {
  constexpr std::uint64_t kCases = 3;
  ValueShares shares;
  for (std::uint64_t i = 0; i < kCases; ++i) {
    OffGrid given = off_grid(subject, grid.steps(), true, i);
    std::optional<cases::Fragments> drawn = subject.draw(given.source);
    if (!drawn) {
      given = off_grid(subject, grid.steps(), false, i);
      drawn = subject.draw(given.source);
    }
    if (!drawn) continue;
    for (std::size_t f = 0; f < drawn->size(); ++f) {
      const std::uint32_t t = drawn->triangle[f];
      if (t >= given.triangles.size()) continue;
      const FineTriangle placed = rounded(given.triangles[t], grid);
      const auto add = [&](Shares& to, float value, const std::array<float, 3>& values) {
        const int x = drawn->x[f];
        const int y = drawn->y[f];
        to.add(double{value}, fine_value_at(given.triangles[t], values, x, y),
               fine_value_at(placed, values, x, y));
      };
      add(shares.depth, drawn->depth[f], depths_of(given.source, given.values[t]));
      const std::span<const float> attributes = drawn->attributes_of(f);
      if (!attributes.empty()) add(shares.smooth, attributes[0], given.values[t]);
      if (attributes.size() > 1) add(shares.noperspective, attributes[1], given.values[t]);
    }
  }
  return shares;
}

/// True if the triangle has this pixel's sample inside.
bool covers(const FineTriangle& t, int x, int y) {
  const FinePlace place = place_in(t, x, y);
  return place.is_inside && place.zero_edges == 0;
}

/// Returns thin triangles whose orientation the grid reverses, with a sample inside the snapped
/// triangle.
std::vector<FineTriangle> turning(const Subject& subject, const MeasuredGrid& grid) {
  constexpr int kTries = 40000;
  constexpr std::size_t kWanted = 32;
  MeasureDraw draw(subject, "facing");
  const std::int64_t unit = kFinePixel / grid.steps();
  std::vector<FineTriangle> found;
  for (int i = 0; i < kTries && found.size() < kWanted; ++i) {
    const int pixel_x = draw.between(20, 40);
    const int pixel_y = draw.between(20, 40);
    const int along_x = draw.between(-3, 3);
    const int along_y = draw.between(-3, 3);
    FineTriangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t place = std::array{-2, 3, 1}[k];
      const auto off = [&] { return unit * draw.between(-140, 140) / 100; };
      t.x[k] = ((2 * (pixel_x + place * along_x) + 1) << (kFineBits - 1)) + off();
      t.y[k] = ((2 * (pixel_y + place * along_y) + 1) << (kFineBits - 1)) + off();
    }
    t = about_samples(subject, t);
    const FineTriangle placed = rounded(t, grid);
    const bool turns =
        (area_of(t) < 0 && area_of(placed) > 0) || (area_of(t) > 0 && area_of(placed) < 0);
    if (turns && covers(placed, pixel_x, pixel_y)) found.push_back(t);
  }
  return found;
}

Shares facing_shares(Subject& subject, const MeasuredGrid& grid) {
  const std::vector<FineTriangle> triangles = turning(subject, grid);
  Shares shares;
  if (triangles.empty()) return shares;
  cases::Case c = subject.base();
  for (const FineTriangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) add_vertex(c, fine_vertex(c, t.x[k], t.y[k], 0.5F));
    const auto end = static_cast<std::uint32_t>(c.positions.size());
    c.triangles.push_back({end - 3, end - 2, end - 1});
  }
  const auto drawn_with = [&](cases::Cull cull) {
    c.cull = cull;
    std::vector<bool> is_drawn(triangles.size());
    const auto drawn = subject.draw(c);
    if (!drawn) return is_drawn;
    for (const std::uint32_t t : drawn->triangle) {
      if (t < is_drawn.size()) is_drawn[t] = true;
    }
    return is_drawn;
  };
  const std::vector<bool> all = drawn_with(cases::Cull::none);
  const std::vector<bool> front = drawn_with(cases::Cull::back);
  const std::vector<bool> back = drawn_with(cases::Cull::front);
  const bool is_y_up = c.rules == cases::Rules::opengl;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!all[t] || front[t] == back[t]) {
      ++shares.too_near;
      continue;
    }
    // A front face is counter-clockwise as displayed: its area is positive if y points up.
    const bool is_front = (area_of(triangles[t]) > 0) == is_y_up;
    ++shares.all;
    ++(front[t] == is_front ? shares.ideal : shares.snapped);
  }
  return shares;
}

/// Returns the answer on which all observations agree; `unspecified` if they disagree.
std::optional<Basis> common(const std::vector<Shares>& all) {
  std::optional<Basis> basis;
  for (const Shares& one : all) {
    const auto found = one.basis();
    if (!found) continue;
    basis = !basis || *basis == *found ? *found : Basis::unspecified;
  }
  return basis;
}

std::optional<Basis> read_basis(Subject& subject, const MeasuredGrid& grid,
                                const std::string& where) {
  const ValueShares values = value_shares(subject, grid);
  const Shares facing = facing_shares(subject, grid);
  const Basis declared = subject.declared().basis;
  const auto add = [&](const char* of, const Shares& shares, const char* unit) {
    const auto basis = shares.basis();
    subject
        .add(fmt::format("basis of {}{}", of, where), std::string(name_of(declared)), shares.text(),
             shares.detail(), shares.sureness(unit))
        .contradicts = declared != Basis::unspecified && basis && *basis != declared;
  };
  add("smooth attributes", values.smooth, "samples");
  add("noperspective attributes", values.noperspective, "samples");
  add("depth", values.depth, "samples");
  add("facing", facing, "triangles");
  return common({values.smooth, values.noperspective, values.depth, facing});
}

}  // namespace

void measure_basis(Subject& subject, const Sight& sight) {
  const MeasuredGrid& grid = sight.fit.grid;
  cases::ContractTerms& terms = subject.result.terms;
  if (!sight.fit.is_explained || sight.fit.samples == 0) {
    subject.add("basis", kNotDeclared, "not measured",
                sight.is_conservative ? "whole pixels are covered" : "no grid is known");
    terms.basis = Basis::unspecified;
    return;
  }
  if (grid.is_none()) {
    subject.add("basis", kNotDeclared, "no grid, so there is only one basis");
    const bool is_exact = terms.coverage == cases::CoverageTerm(cases::Coverage());
    terms.basis = is_exact ? Basis::ideal : Basis::unspecified;
    return;
  }
  const AskedDrawing said = subject.asked();
  if (said.basis) {
    terms.basis = read_basis(subject, grid, "").value_or(Basis::unspecified);
    return;
  }
  AskedDrawing asked = said;
  asked.basis = Basis::snapped;
  subject.ask(asked);
  const std::size_t before = subject.result.rows.size();
  const auto snapped = read_basis(subject, grid, " if snapped is requested");
  asked.basis = Basis::ideal;
  subject.ask(asked);
  const std::size_t between = subject.result.rows.size();
  const auto ideal = read_basis(subject, grid, " if ideal is requested");
  subject.ask(said);
  if (snapped == Basis::snapped && ideal == Basis::ideal) {
    terms.basis = cases::AsAsked{};
    return;
  }
  terms.basis = snapped == ideal ? ideal.value_or(Basis::unspecified) : Basis::unspecified;
  if (snapped != ideal) return;
  // The answer is the same whatever the case asks for, so it is reported once.
  std::vector<records::Measured>& rows = subject.result.rows;
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(between), rows.end());
  for (std::size_t i = before; i < rows.size(); ++i) {
    rows[i].what = rows[i].what.substr(0, rows[i].what.find(" if "));
  }
}

}  // namespace rastercheck::properties
