// Measures who owns samples on edges.
//
// Many of the triangles from the grid measure, once rounded to the grid, have an edge exactly
// through a sample. Whether such a sample was drawn is counted under the direction of the edge's
// inward normal. The rules distinguish eight directions: along the axes and between them. An API's
// rule fits if all eight directions agree with it. Samples on two edges are left out.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

#include "cases/names.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using cases::TieRule;

/// Counts ties of one direction.
struct Owned {
  int drawn = 0;
  int seen = 0;
};

/// [1 + sign of the normal's x][1 + sign of the normal's y]; [1][1] counts samples on two edges.
using Directions = std::array<std::array<Owned, 3>, 3>;

std::size_t index_of(std::int64_t number) {
  return number < 0 ? 0 : static_cast<std::size_t>(number > 0 ? 2 : 1);
}

Directions directions_of(const MeasuredGrid& grid, const std::vector<FineDrawing>& drawings) {
  Directions directions;
  for (const FineDrawing& drawing : drawings) {
    for (std::size_t i = 0; i < drawing.triangles.size(); ++i) {
      const FineTriangle placed = rounded(drawing.triangles[i], grid);
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          const FinePlace place = place_in(placed, x, y);
          if (place.is_inside && place.zero_edges > 1) ++directions[1][1].seen;
          if (!place.is_inside || place.zero_edges != 1) continue;
          Owned& owned = directions[index_of(place.normal_x)][index_of(place.normal_y)];
          const std::uint64_t row = drawing.rows[i][static_cast<std::size_t>(y)];
          ++owned.seen;
          owned.drawn += ((row >> static_cast<unsigned>(x)) & 1U) != 0 ? 1 : 0;
        }
      }
    }
  }
  return directions;
}

/// The rules that are told apart, those that APIs have first.
constexpr std::array kRules{TieRule::top_left,
                            TieRule::bottom_left,
                            TieRule::top_right,
                            TieRule::bottom_right,
                            TieRule::top_then_left,
                            TieRule::top_then_right,
                            TieRule::bottom_then_left,
                            TieRule::bottom_then_right,
                            TieRule::all,
                            TieRule::none};

/// True if a rule owns samples on an edge whose inward normal points in this direction (RULES §2,
/// §13): x and y are 0, 1 and 2 for towards lesser, neither and towards greater coordinates.
bool owns(TieRule rule, bool is_y_up, std::size_t x, std::size_t y) {
  if (rule == TieRule::all || rule == TieRule::none) return rule == TieRule::all;
  const auto is_one_of = [rule](std::initializer_list<TieRule> rules) {
    return std::find(rules.begin(), rules.end(), rule) != rules.end();
  };
  using enum TieRule;
  const bool is_left = is_one_of({top_left, bottom_left, top_then_left, bottom_then_left});
  const bool is_top = is_one_of({top_left, top_right, top_then_left, top_then_right});
  const bool asks_x_first = is_one_of({top_left, bottom_left, top_right, bottom_right});
  const std::size_t owned_x = is_left ? 2 : 0;
  const std::size_t owned_y = is_top != is_y_up ? 2 : 0;
  if (asks_x_first) return x == owned_x || (x == 1 && y == owned_y);
  return y == owned_y || (y == 1 && x == owned_x);
}

/// For a backend whose grid is unknown: `all` if some of its triangles are too large and none too
/// small, so that samples near a shared edge are drawn twice; `none` the other way round.
std::optional<TieRule> rule_of_sizes(const std::vector<FineDrawing>& drawings) {
  bool has_extra = false;
  bool has_missing = false;
  for (const FineDrawing& drawing : drawings) {
    for (std::size_t i = 0; i < drawing.triangles.size(); ++i) {
      const FineTriangle& t = drawing.triangles[i];
      if (area_of(t) == 0) continue;
      const FineEdges edges = edges_of(t);
      for (int y = 0; y < kFineSide; ++y) {
        for (int x = 0; x < kFineSide; ++x) {
          const double depth = depth_inside(edges, x, y);
          const bool is_drawn = has(drawing.rows[i], x, y);
          has_extra = has_extra || (is_drawn && depth < 0);
          has_missing = has_missing || (!is_drawn && depth > 0);
        }
      }
    }
  }
  if (has_extra == has_missing) return std::nullopt;
  return has_extra ? TieRule::all : TieRule::none;
}

struct TieReading {
  std::optional<TieRule> rule;  ///< empty if ties were not seen, or not all went by one rule
  bool is_seen = false;
  std::string text;
  records::Sureness sureness;
};

/// Of several rules that explain what was seen, the declared one is named if it is among them.
TieReading read(const Directions& directions, bool is_y_up, TieRule declared) {
  constexpr std::array<std::array<const char*, 3>, 3> kNames{
      {{"−x−y", "−x", "−x+y"}, {"−y", "", "+y"}, {"+x−y", "+x", "+x+y"}}};
  int seen = 0;
  int against = 0;
  std::string owners;
  std::vector<TieRule> kept(kRules.begin(), kRules.end());
  for (std::size_t x = 0; x < 3; ++x) {
    for (std::size_t y = 0; y < 3; ++y) {
      const Owned& one = directions[x][y];
      if ((x == 1 && y == 1) || one.seen == 0) continue;
      seen += one.seen;
      const bool is_owner = 2 * one.drawn >= one.seen;
      against += is_owner ? one.seen - one.drawn : one.drawn;
      if (is_owner) owners += fmt::format("{}{}", owners.empty() ? "" : ", ", kNames[x][y]);
      std::erase_if(kept, [&](TieRule rule) { return is_owner != owns(rule, is_y_up, x, y); });
    }
  }
  TieReading reading;
  reading.is_seen = seen > 0;
  reading.sureness = sure_of("samples", seen - against, against, directions[1][1].seen);
  if (seen == 0) {
    reading.text = "not seen";
  } else if (!kept.empty()) {
    const bool is_declared = std::find(kept.begin(), kept.end(), declared) != kept.end();
    const TieRule rule = is_declared ? declared : kept.front();
    reading.text = name_of(rule);
    if (against == 0) reading.rule = rule;
  } else {
    reading.text = "of another kind: inward normals towards " + owners;
  }
  return reading;
}

std::string declared_tie_rule(TieRule rule) {
  return rule == TieRule::unspecified ? "unspecified" : std::string(name_of(rule));
}

}  // namespace

void measure_ties(Subject& subject, const Sight& sight) {
  if (sight.is_conservative) return;
  // If no grid is known, ties are known only of vertices in the middle of pixels, which most grids
  // have points for: those of the first drawing.
  const auto known = [&sight](std::vector<FineDrawing> drawings) {
    if (!sight.fit.is_explained && drawings.size() > 1) drawings.resize(1);
    return drawings;
  };
  const AskedDrawing said = subject.asked();
  const bool is_y_up = subject.base().rules == cases::Rules::opengl;
  const auto reading_of = [&](TieRule rule) {
    AskedDrawing asked = said;
    asked.fill_rule = rule;
    subject.ask(asked);
    return read(directions_of(sight.fit.grid, known(draw_grid_cases(subject))), is_y_up,
                subject.declared().tie_rule);
  };
  const auto declared = [&subject] { return subject.declared().tie_rule; };
  const auto add = [&subject](const char* what, TieRule rule, const TieReading& reading) {
    subject.add(what, declared_tie_rule(rule), reading.text, "", reading.sureness).contradicts =
        rule != TieRule::unspecified && reading.is_seen && reading.rule != rule;
  };
  cases::ContractTerms& terms = subject.result.terms;
  if (!sight.fit.is_explained) {
    if (const auto rule = rule_of_sizes(sight.drawings)) {
      subject
          .add("tie rule", declared_tie_rule(declared()), std::string(name_of(*rule)),
               "also for samples off the edges")
          .contradicts = declared() != *rule && declared() != TieRule::unspecified;
      terms.tie_rule = *rule;
      return;
    }
  }
  if (said.fill_rule) {
    const TieReading reading =
        read(directions_of(sight.fit.grid, known(sight.drawings)), is_y_up, declared());
    add("tie rule", declared(), reading);
    terms.tie_rule = reading.rule.value_or(TieRule::unspecified);
    return;
  }
  const TieReading bottom = reading_of(TieRule::bottom_left);
  const TieRule bottom_declared = declared();
  const TieReading top = reading_of(TieRule::top_left);
  const bool is_followed = top.rule == TieRule::top_left && bottom.rule == TieRule::bottom_left;
  if (is_followed || top.rule != bottom.rule) {
    add("tie rule if top_left is requested", declared(), top);
    add("tie rule if bottom_left is requested", bottom_declared, bottom);
  } else {
    add("tie rule", declared(), top);
  }
  if (is_followed) {
    terms.tie_rule = cases::AsAsked{};
  } else {
    terms.tie_rule =
        top.rule == bottom.rule ? top.rule.value_or(TieRule::unspecified) : TieRule::unspecified;
  }
  subject.ask(said);
}

}  // namespace rastercheck::properties
