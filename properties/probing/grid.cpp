#include "properties/probing/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
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

/// A triangle with an edge through a sample, whose vertices are then moved by a few units of 2^-k
/// pixels; not moved if k is 0.
FineTriangle near_sample(Draw& draw, int k) {
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
    const auto pixels = static_cast<double>(kFinePixel);
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
        columns_(pixel_range(at_.x)),
        lines_(pixel_range(at_.y)) {}

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

/// Looks for the grid, moves and roundings that agree best with drawings.
class GridSearch {
 public:
  GridSearch(const Subject& subject, const std::vector<FineDrawing>& drawings)
      : subject_(&subject), drawings_(&drawings) {}

  /// Returns the grid and rounding with the fewest mismatches, without a move.
  GridFit best_grid() const {
    GridFit best = fit({0});
    for (int bits = 0; bits <= cases::kMaxSubpixelBits; ++bits) {
      for (const GridRounding x : kRoundings) improve({bits, x, x}, best);
    }
    // The axes may differ, for example if window y is flipped before it is rounded.
    const int near = best.grid.bits;
    for (int bits = std::max(near - 1, 0); bits <= std::min(near + 1, cases::kMaxSubpixelBits);
         ++bits) {
      for (const GridRounding x : kRoundings) {
        for (const GridRounding y : kRoundings) improve({bits, x, y}, best);
      }
    }
    return best;
  }

  /// Returns the best rounding to this many bits, without a move.
  GridFit best_rounding(int bits) const {
    GridFit best = fit({bits});
    for (const GridRounding x : kRoundings) {
      for (const GridRounding y : kRoundings) improve({bits, x, y}, best);
    }
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

 private:
  static MeasuredGrid moved(MeasuredGrid grid, std::int64_t x, std::int64_t y) {
    grid.move_x += x;
    grid.move_y += y;
    return grid;
  }

  GridFit fit(const MeasuredGrid& grid) const {
    return fit_of(grid, *drawings_, std::numeric_limits<std::uint64_t>::max());
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
};

/// Returns the fit without a grid: without a move if that explains everything or if a move explains
/// no more.
GridFit fit_of_none(const GridSearch& search, const std::vector<FineDrawing>& drawings) {
  const GridFit plain = fit_of({}, drawings, std::numeric_limits<std::uint64_t>::max());
  if (plain.mismatches == 0) return plain;
  // A mismatch that lies farther away is no matter of a move that is worth looking for.
  constexpr std::int64_t kFarthest = kFinePixel / 2;
  GridFit moved = search.best_move({}, kFarthest);
  const bool is_needed = grid_votes(moved.grid, {}, drawings).are_for_it();
  return is_needed ? moved : plain;
}

/// The greatest error of an edge function a x + b y + c in float32, in pixels²: within 64 pixels
/// its terms are below 2^12, so each of five roundings is off by 2^-12 at most.
constexpr double kFloatEdges = 5 * 0x1p-12;

}  // namespace

std::int64_t rounded(std::int64_t fine, int bits, GridRounding rounding) {
  const int shift = kFineBits - bits;
  if (shift == 0) return fine;
  const std::int64_t unit = std::int64_t{1} << shift;
  const std::int64_t below = fine >> shift;  // towards −∞
  const std::int64_t rest = 2 * (fine - below * unit);
  bool goes_up = rest > unit;
  if (rounding == GridRounding::down) goes_up = false;
  if (rounding == GridRounding::up) goes_up = rest > 0;
  if (rest == unit && rounding == GridRounding::nearest_even) goes_up = below % 2 != 0;
  if (rest == unit && rounding == GridRounding::half_up) goes_up = true;
  return (below + (goes_up ? 1 : 0)) * unit;
}

FineTriangle rounded(const FineTriangle& triangle, const MeasuredGrid& grid) {
  FineTriangle placed;
  for (std::size_t i = 0; i < 3; ++i) {
    placed.x[i] = rounded(triangle.x[i] + grid.move_x, grid.bits, grid.x);
    placed.y[i] = rounded(triangle.y[i] + grid.move_y, grid.bits, grid.y);
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
      triangles.push_back(near_sample(draw, k));
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
      least.mismatches == 0 && grid_votes(least.grid, {}, drawings).are_nearly_all();
  if (is_whole && least.grid.bits < kFineGrid) return least;
  const GridFit none = fit_of_none(search, drawings);
  if (none.mismatches == 0) return none;
  if (is_whole && grid_votes(least.grid, none.grid, drawings).are_for_it()) return least;
  GridFit best = none;
  for (int bits = cases::kMaxSubpixelBits; bits >= 0; --bits) {
    GridFit fit = search.best_rounding(bits);
    // Only the best grids are worth the search for a move.
    if (fit.mismatches > 0 && std::abs(bits - least.grid.bits) <= 1) {
      MeasuredGrid moved = none.grid;
      moved.bits = bits;
      const GridFit better = search.best_move(moved, kFinePixel >> bits);
      if (grid_votes(better.grid, fit.grid, drawings).are_for_it()) fit = better;
    }
    const bool is_better = grid_votes(fit.grid, best.grid, drawings).are_for_it();
    if (is_better && grid_votes(fit.grid, {}, drawings).are_nearly_all()) best = fit;
  }
  best.is_explained = !best.grid.is_none() || best.most_wrong <= kFloatEdges;
  if (best.is_explained) return best;
  GridFit unexplained = fit_of({}, drawings, std::numeric_limits<std::uint64_t>::max());
  unexplained.is_explained = false;
  return unexplained;
}

std::string to_string(const GridFit& fit) {
  const MeasuredGrid& grid = fit.grid;
  if (fit.samples == 0) return "not drawn";
  if (!fit.is_explained) {
    return fmt::format("none of the grids 2^-0 to 2^-{} explains it", cases::kMaxSubpixelBits);
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
  std::string text =
      fmt::format("{} bits, {}", grid.bits, x == y ? x : x + " in x, " + y + " in y");
  if (grid.is_moved()) {
    const auto unit = static_cast<double>(kFinePixel >> grid.bits);
    text += fmt::format(", after a move by about {} grid units", moves(unit, 1));
  }
  return text;
}

records::Sureness sureness_of(const GridFit& fit) {
  return {"samples", fit.samples - std::min(fit.samples, fit.mismatches), fit.mismatches, fit.ties};
}

}  // namespace rastercheck::properties
