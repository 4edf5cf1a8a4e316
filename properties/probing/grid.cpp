#include "properties/probing/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace rastercheck::properties {
namespace {

/// Triangles per case; there is one case per size of move.
constexpr int kTriangles = 64;

constexpr std::array kRoundings{GridRounding::nearest_even, GridRounding::half_up,
                                GridRounding::half_down, GridRounding::down, GridRounding::up};

const char* name_of(GridRounding rounding) {
  switch (rounding) {
    case GridRounding::nearest_even:
      return "nearest_even";
    case GridRounding::half_up:
      return "half_up";
    case GridRounding::half_down:
      return "half_down";
    case GridRounding::down:
      return "down";
    case GridRounding::up:
      break;
  }
  return "up";
}

/// Grids of 1/n pixel with a greater n, no power of two, are not told from none.
constexpr int kMostOtherSteps = 1024;
/// Most units per fine unit. The triangles of near_centre() are at most 31 pixels wide and lie
/// between 4 and 60 pixels, and samples in the window are less than 60 pixels away; so an edge
/// function is less than 2 · 31 · 60 · 2^36 · 180² < 2^63.
constexpr int kMostParts = 180;

/// Returns the units per fine unit in which the grid's points are whole and, if that is no more
/// than kMostParts, samples too.
int parts_of(const MeasuredGrid& grid) {
  const int odd_parts =
      grid.sample.parts >> std::countr_zero(static_cast<unsigned>(grid.sample.parts));
  const int both = std::lcm(grid.odd_steps, odd_parts);
  return both <= kMostParts ? both : grid.odd_steps;
}

/// A triangle with an edge through a pixel's centre, whose vertices are then moved by a few units
/// of 2^-k pixels; not moved if k is 0.
FineTriangle near_centre(Draw& draw, int k) {
  const std::int64_t sample_x = draw.between(20, 43) * kFinePixel + kFinePixel / 2;
  const std::int64_t sample_y = draw.between(20, 43) * kFinePixel + kFinePixel / 2;
  // A quarter of the edges are vertical or horizontal: ties on such edges are a special case.
  const bool is_along = draw.one_in(4);
  const bool is_level = draw.one_in(2);
  int along_x = draw.between(-4, 4);
  int along_y = draw.between(-4, 4);
  if (is_along) (is_level ? along_y : along_x) = 0;
  if (along_x == 0 && along_y == 0) (is_level ? along_x : along_y) = 3;
  const std::int64_t before = draw.between(1, 3);
  const std::int64_t beyond = draw.between(1, 3);
  const std::int64_t away = draw.one_in(2) ? 1 : -1;
  const std::int64_t slide = draw.between(-3, 3);
  FineTriangle triangle;
  triangle.x = {sample_x + before * along_x * kFinePixel, sample_x - beyond * along_x * kFinePixel,
                sample_x + (slide - 2 * away * along_y) * kFinePixel};
  triangle.y = {sample_y + before * along_y * kFinePixel, sample_y - beyond * along_y * kFinePixel,
                sample_y + (slide + 2 * away * along_x) * kFinePixel};
  const std::int64_t unit = k == 0 ? 0 : kFinePixel >> k;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.x[i] += draw.between(-7, 7) * unit;
    triangle.y[i] += draw.between(-7, 7) * unit;
  }
  return triangle;
}

/// How wrong an answer about a sample is.
struct Wrongness {
  double move = 0;  ///< how far an edge has to move for the answer to change, in pixels per axis
  double edge = 0;  ///< the edge function that has the wrong sign, in pixels²
};

Wrongness wrongness_of(const FineEdges& edges, int x, int y, bool is_drawn) {
  constexpr double kMost = std::numeric_limits<double>::max();
  Wrongness outside;
  Wrongness inside{kMost, kMost};
  for (const FineEdge& edge : edges) {
    if (edge.a == 0 && edge.b == 0) continue;
    const double distance = edge.distance(x, y);
    const auto pixels = static_cast<double>(edge.pixel);
    const double value = static_cast<double>(edge.at(x, y)) / pixels / pixels;
    outside = {std::max(outside.move, -distance), std::max(outside.edge, -value)};
    inside = {std::min(inside.move, distance), std::min(inside.edge, value)};
  }
  return is_drawn ? outside : inside;
}

/// A triangle as a grid places it, and what it predicts.
class PlacedTriangle {
 public:
  PlacedTriangle(const FineTriangle& triangle, const MeasuredGrid& grid)
      : at_(rounded(triangle, grid)),
        edges_(edges_of(at_)),
        is_flat_(area_of(at_) == 0),
        columns_(columns_of(at_)),
        lines_(lines_of(at_)) {}

  /// Positive inside, negative outside, 0 on an edge.
  std::int64_t sign_at(int x, int y) const {
    if (is_flat_) return -1;
    std::int64_t least = edges_[0].at(x, y);
    for (const FineEdge& edge : {edges_[1], edges_[2]}) least = std::min(least, edge.at(x, y));
    return least;
  }
  const FineEdges& edges() const { return edges_; }
  /// Pixels whose samples may be inside: begin and end.
  const std::pair<int, int>& columns() const { return columns_; }
  const std::pair<int, int>& lines() const { return lines_; }

 private:
  FineTriangle at_;
  FineEdges edges_;
  bool is_flat_;
  std::pair<int, int> columns_;
  std::pair<int, int> lines_;
};

/// The bits of these columns, begin and end.
std::uint64_t columns_mask(int begin, int end) {
  const std::uint64_t below = end >= kFineSide ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - 1;
  return below & ~((std::uint64_t{1} << begin) - 1);
}

void compare(const PlacedTriangle& placed, const FineRows& rows, GridFit& fit) {
  const auto [x0, x1] = placed.columns();
  for (int y = 0; y < kFineSide; ++y) {
    const bool is_within = y >= placed.lines().first && y < placed.lines().second;
    std::uint64_t beyond = rows[static_cast<std::size_t>(y)];
    if (is_within && x0 < x1) beyond &= ~columns_mask(x0, x1);
    if (beyond != 0) {
      // At least a pixel away from the triangle.
      ++fit.mismatches;
      fit.farthest = std::max(fit.farthest, 1.0);
      fit.most_wrong = std::max(fit.most_wrong, 1.0);
    }
    if (!is_within) continue;
    for (int x = x0; x < x1; ++x) {
      const std::int64_t sign = placed.sign_at(x, y);
      if (sign == 0) {
        ++fit.ties;
        continue;
      }
      const bool is_drawn = has(rows, x, y);
      ++fit.samples;
      if ((sign > 0) == is_drawn) continue;
      ++fit.mismatches;
      const Wrongness wrongness = wrongness_of(placed.edges(), x, y, is_drawn);
      fit.farthest = std::max(fit.farthest, wrongness.move);
      fit.most_wrong = std::max(fit.most_wrong, wrongness.edge);
    }
  }
}

/// Compares a grid's predictions with what was drawn; stops once there are more than `most`
/// mismatches.
GridFit fit_of(const MeasuredGrid& grid, const std::vector<FineDrawing>& drawings,
               std::uint64_t most) {
  GridFit fit{grid};
  for (const FineDrawing& drawing : drawings) {
    for (std::size_t i = 0; i < drawing.triangles.size(); ++i) {
      compare({drawing.triangles[i], grid}, drawing.rows[i], fit);
      if (fit.mismatches > most) return fit;
    }
  }
  return fit;
}

/// Triangles of which one grid explains more samples than another.
struct GridVotes {
  std::uint64_t in_favour = 0;
  std::uint64_t against = 0;

  /// True if the one grid explains much more: fewer than eight triangles may agree by chance.
  bool are_for_it() const { return in_favour >= 8 + 3 * against; }
  /// True if the one grid is right about (nearly) all.
  bool are_nearly_all() const { return in_favour >= 8 && in_favour >= 9 * against; }
};

/// Counts triangles by the samples that both grids decide, in different ways.
GridVotes grid_votes(const MeasuredGrid& one, const MeasuredGrid& other,
                     const std::vector<FineDrawing>& drawings) {
  GridVotes votes;
  for (const FineDrawing& drawing : drawings) {
    for (std::size_t i = 0; i < drawing.triangles.size(); ++i) {
      const PlacedTriangle by_one(drawing.triangles[i], one);
      const PlacedTriangle by_other(drawing.triangles[i], other);
      const auto [x0, x1] = std::pair(std::min(by_one.columns().first, by_other.columns().first),
                                      std::max(by_one.columns().second, by_other.columns().second));
      const auto [y0, y1] = std::pair(std::min(by_one.lines().first, by_other.lines().first),
                                      std::max(by_one.lines().second, by_other.lines().second));
      int balance = 0;
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
          const std::int64_t a = by_one.sign_at(x, y);
          const std::int64_t b = by_other.sign_at(x, y);
          if (a == 0 || b == 0 || (a > 0) == (b > 0)) continue;
          balance += (a > 0) == has(drawing.rows[i], x, y) ? 1 : -1;
        }
      }
      votes.in_favour += balance > 0 ? 1U : 0U;
      votes.against += balance < 0 ? 1U : 0U;
    }
  }
  return votes;
}

/// Looks for the grid, moves, roundings and samples that agree best with drawings.
class GridSearch {
 public:
  GridSearch(const Subject& subject, const std::vector<FineDrawing>& drawings)
      : subject_(&subject), drawings_(&drawings) {
    none_.sample = subject.sample();
  }

  /// No grid, no move, and samples where the backend declares them.
  const MeasuredGrid& none() const { return none_; }

  GridFit fit(const MeasuredGrid& grid) const {
    return fit_of(grid, *drawings_, std::numeric_limits<std::uint64_t>::max());
  }

  /// Returns the grid of 2^-n pixels and rounding with the fewest mismatches, without a move.
  GridFit best_grid() const {
    GridFit best = fit(of(0));
    for (int bits = 0; bits <= cases::kMaxSubpixelBits; ++bits) {
      for (const GridRounding x : kRoundings) improve(of(bits, x, x), best);
    }
    // The axes may differ, for example if window y is flipped before it is rounded.
    const int near = best.grid.bits;
    for (int bits = std::max(near - 1, 0); bits <= std::min(near + 1, cases::kMaxSubpixelBits);
         ++bits) {
      improve_rounding(of(bits), best);
    }
    return best;
  }

  /// Returns the best rounding to this many bits, without a move.
  GridFit best_rounding(int bits) const {
    GridFit best = fit(of(bits));
    improve_rounding(of(bits), best);
    return best;
  }

  /// Returns the best move near `from`, before rounding to the nearest of this many bits: first on
  /// a coarse lattice up to `reach` fine units away, then in ever smaller steps.
  GridFit best_move(const MeasuredGrid& from, std::int64_t reach) const {
    GridFit best = fit(from);
    const std::int64_t coarse = std::max<std::int64_t>(1, reach / 8);
    for (std::int64_t x = -reach; x <= reach; x += coarse) {
      for (std::int64_t y = -reach; y <= reach; y += coarse) improve(moved(from, x, y), best);
    }
    for (std::int64_t step = coarse; step > 0; step /= 2) {
      // Each step may have to be made more than once, as the best place need not be the nearest.
      for (bool is_better = true; is_better;) {
        const MeasuredGrid around = best.grid;
        is_better = false;
        for (const std::int64_t x : {-step, std::int64_t{0}, step}) {
          for (const std::int64_t y : {-step, std::int64_t{0}, step}) {
            is_better = improve(moved(around, x, y), best) || is_better;
          }
        }
      }
    }
    return best;
  }

  /// Returns the finest grid of 1/n pixel, n no power of two, that explains everything.
  std::optional<GridFit> other_grid() const {
    for (int steps = kMostOtherSteps; steps >= 3; --steps) {
      MeasuredGrid grid = of_steps(steps);
      if (grid.odd_steps == 1 || grid.odd_steps > kMostParts) continue;
      for (const GridRounding x : kRoundings) {
        for (const GridRounding y : kRoundings) {
          grid.x = x;
          grid.y = y;
          if (const auto found = whole_fit(grid)) return found;
        }
      }
    }
    return std::nullopt;
  }

  /// Returns the finest grid that explains everything with samples on one of its points. `moved`:
  /// the move that explains most without a grid.
  std::optional<GridFit> grid_of_samples(const MeasuredGrid& moved) const {
    for (int steps = cases::kMostPixelParts; steps >= 1; --steps) {
      MeasuredGrid grid = of_steps(steps);
      if (grid.odd_steps > kMostParts) continue;
      for (const GridRounding rounding : kRoundings) {
        grid.x = grid.y = rounding;
        const int x = grid_point_near(none_.sample.x, moved.move_x, grid);
        const int y = grid_point_near(none_.sample.y, moved.move_y, grid);
        for (int i = 0; i < 9; ++i) {
          const cases::PixelFraction at{x - 1 + i % 3, y - 1 + i / 3, steps};
          if (std::min(at.x, at.y) < 0 || std::max(at.x, at.y) >= steps) continue;
          grid.sample = in_lowest_terms(at);
          if (const auto found = whole_fit(grid)) return found;
        }
      }
    }
    return std::nullopt;
  }

 private:
  static MeasuredGrid moved(MeasuredGrid grid, std::int64_t x, std::int64_t y) {
    grid.move_x += x;
    grid.move_y += y;
    return grid;
  }

  MeasuredGrid of(int bits, GridRounding x = GridRounding::nearest_even,
                  GridRounding y = GridRounding::nearest_even) const {
    MeasuredGrid grid = none_;
    grid.bits = bits;
    grid.x = x;
    grid.y = y;
    return grid;
  }
  MeasuredGrid of_steps(int steps) const {
    const int bits = std::countr_zero(static_cast<unsigned>(steps));
    MeasuredGrid grid = of(bits);
    grid.odd_steps = steps >> bits;
    return grid;
  }

  /// Returns the grid point near the samples for which positions rounded to the grid look, on
  /// average, as if they were moved by `move`: s' = s + bias − move.
  int grid_point_near(int sample, std::int64_t move, const MeasuredGrid& grid) const {
    const double bias = grid.x == GridRounding::down ? -0.5 : grid.x == GridRounding::up ? 0.5 : 0;
    const double at = static_cast<double>(sample) / none_.sample.parts -
                      static_cast<double>(move) / static_cast<double>(kFinePixel);
    return static_cast<int>(std::lround(at * grid.steps() + bias));
  }

  /// Returns the fit if it has no mismatch, although the grid matters.
  std::optional<GridFit> whole_fit(const MeasuredGrid& grid) const {
    if (subject_->is_time_up()) return std::nullopt;
    const GridFit found = fit_of(grid, *drawings_, 0);
    if (found.mismatches > 0) return std::nullopt;
    if (!grid_votes(grid, none_, *drawings_).are_nearly_all()) return std::nullopt;
    return found;
  }

  void improve_rounding(MeasuredGrid grid, GridFit& best) const {
    for (const GridRounding x : kRoundings) {
      for (const GridRounding y : kRoundings) {
        grid.x = x;
        grid.y = y;
        improve(grid, best);
      }
    }
  }

  bool improve(const MeasuredGrid& grid, GridFit& best) const {
    if (best.mismatches == 0 || subject_->is_time_up()) return false;
    const GridFit found = fit_of(grid, *drawings_, best.mismatches);
    if (found.mismatches >= best.mismatches) return false;
    best = found;
    return true;
  }

  const Subject* subject_;
  const std::vector<FineDrawing>* drawings_;
  MeasuredGrid none_;
};

/// A mismatch that lies farther away is no matter of a move that is worth looking for.
constexpr std::int64_t kFarthestMove = kFinePixel / 2;

/// Fits without a grid.
struct FitsOfNone {
  GridFit unmoved;
  GridFit moved;
  /// The first, unless the move explains much more.
  GridFit best;
};
FitsOfNone fits_of_none(const GridSearch& search, const std::vector<FineDrawing>& drawings) {
  const GridFit unmoved = search.fit(search.none());
  if (unmoved.mismatches == 0) return {unmoved, unmoved, unmoved};
  const GridFit moved = search.best_move(search.none(), kFarthestMove);
  const bool is_needed = grid_votes(moved.grid, search.none(), drawings).are_for_it();
  return {unmoved, moved, is_needed ? moved : unmoved};
}

/// The greatest error of an edge function a x + b y + c in float32, in pixels²: within 64 pixels
/// its terms are below 2^12, so each of five roundings is off by 2^-12 at most.
constexpr double kFloatEdges = 5 * 0x1p-12;

}  // namespace

std::int64_t rounded(std::int64_t coordinate, std::int64_t unit, GridRounding rounding) {
  const std::int64_t rest = ((coordinate % unit) + unit) % unit;
  const std::int64_t below = coordinate - rest;  // towards −∞
  bool goes_up = 2 * rest > unit;
  if (rounding == GridRounding::down) goes_up = false;
  if (rounding == GridRounding::up) goes_up = rest > 0;
  if (2 * rest == unit && rounding == GridRounding::nearest_even) goes_up = below / unit % 2 != 0;
  if (2 * rest == unit && rounding == GridRounding::half_up) goes_up = true;
  return below + (goes_up ? unit : 0);
}

FineTriangle rounded(const FineTriangle& triangle, const MeasuredGrid& grid) {
  const std::int64_t parts = parts_of(grid);
  const std::int64_t unit = (parts / grid.odd_steps) << (kFineBits - grid.bits);
  FineTriangle placed;
  placed.scale = scale_of(grid.sample, parts);
  for (std::size_t i = 0; i < 3; ++i) {
    placed.x[i] = rounded(parts * (triangle.x[i] + grid.move_x), unit, grid.x);
    placed.y[i] = rounded(parts * (triangle.y[i] + grid.move_y), unit, grid.y);
  }
  return placed;
}

std::vector<FineDrawing> draw_grid_cases(Subject& subject) {
  std::vector<FineDrawing> drawings;
  for (int k = 0; k <= kFineBits; ++k) {  // 0: nothing is moved
    MeasureDraw draw(subject, "grid", static_cast<std::uint64_t>(k));
    std::vector<FineTriangle> triangles;
    triangles.reserve(kTriangles);
    for (int i = 0; i < kTriangles; ++i) {
      triangles.push_back(about_samples(subject, near_centre(draw, k)));
    }
    if (auto drawing = draw_fine(subject, triangles)) drawings.push_back(*std::move(drawing));
  }
  return drawings;
}

GridFit fit_grid(const Subject& subject, const std::vector<FineDrawing>& drawings) {
  const GridSearch search(subject, drawings);
  const GridFit least = search.best_grid();
  // A move can explain a drawing as well as fine grids do, but not one that a coarse grid explains
  // wholly.
  constexpr int kFineGrid = 14;
  const bool is_whole =
      least.mismatches == 0 && grid_votes(least.grid, search.none(), drawings).are_nearly_all();
  if (is_whole && least.grid.bits < kFineGrid) return least;
  const FitsOfNone none = fits_of_none(search, drawings);
  if (none.best.mismatches == 0) return none.best;
  if (is_whole && grid_votes(least.grid, none.best.grid, drawings).are_for_it()) return least;
  if (const auto found = search.other_grid()) return *found;
  if (const auto found = search.grid_of_samples(none.moved.grid)) return *found;
  GridFit best = none.best;
  for (int bits = cases::kMaxSubpixelBits; bits >= 0; --bits) {
    GridFit fit = search.best_rounding(bits);
    // Only the best grids are worth the search for a move.
    if (fit.mismatches > 0 && std::abs(bits - least.grid.bits) <= 1) {
      MeasuredGrid moved = none.best.grid;
      moved.bits = bits;
      const GridFit better = search.best_move(moved, kFinePixel >> bits);
      if (grid_votes(better.grid, fit.grid, drawings).are_for_it()) fit = better;
    }
    const bool is_better = grid_votes(fit.grid, best.grid, drawings).are_for_it();
    if (is_better && grid_votes(fit.grid, search.none(), drawings).are_nearly_all()) best = fit;
  }
  best.is_explained = !best.grid.is_none() || best.most_wrong <= kFloatEdges;
  if (best.is_explained) return best;
  GridFit unexplained = none.unmoved;
  unexplained.is_explained = false;
  return unexplained;
}

std::string to_string(const GridFit& fit) {
  const MeasuredGrid& grid = fit.grid;
  if (fit.samples == 0) return "not drawn";
  if (!fit.is_explained) {
    return fmt::format("none of the grids 2^-0 to 2^-{}, or of most others to 1/{}, explains it",
                       cases::kMaxSubpixelBits, kMostOtherSteps);
  }
  const auto moves = [&grid](double unit, int digits) {
    return fmt::format("({:.{}g}, {:.{}g})", static_cast<double>(grid.move_x) / unit, digits,
                       static_cast<double>(grid.move_y) / unit, digits);
  };
  if (grid.is_none()) {
    std::string text = "none: positions are not rounded";
    if (grid.is_moved()) {
      text += fmt::format(", but moved by {} pixels", moves(static_cast<double>(kFinePixel), 3));
    }
    if (fit.mismatches > 0) {
      text += fmt::format("; edges are off by up to {:.2g} pixels", fit.farthest);
    }
    return text;
  }
  const std::string x = name_of(grid.x);
  const std::string y = name_of(grid.y);
  std::string text = grid.odd_steps == 1 ? fmt::format("{} bits", grid.bits)
                                         : fmt::format("1/{} pixel", grid.steps());
  text += ", " + (x == y ? x : x + " in x, " + y + " in y");
  if (grid.is_moved()) {
    const auto unit = static_cast<double>(kFinePixel) / grid.steps();
    text += fmt::format(", after a move by about {} grid units", moves(unit, 1));
  }
  return text;
}

records::Sureness sureness_of(const GridFit& fit) {
  return {"samples", fit.samples - std::min(fit.samples, fit.mismatches), fit.mismatches, fit.ties};
}

}  // namespace rastercheck::properties
