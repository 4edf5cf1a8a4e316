#include "properties/probing/placement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace rastercheck::properties {
namespace {

using records::Sureness;

/// Moves of up to a pixel and a viewport that is up to a pixel too small displace nothing by more
/// than this, in pixels.
constexpr double kTurnMargin = 2;
/// Fewer votes than this prove nothing.
constexpr std::uint64_t kFewestVotes = 16;
/// Greatest move that is tried, in half pixels.
constexpr int kMostMoved = 2;

enum class Predicted { inside, outside, open };

/// Predicts the samples of one triangle.
class Prediction {
 public:
  Prediction(const FineTriangle& triangle, const Placement& placement, double margin)
      : Prediction(placed(triangle, placement), margin) {}

  /// True if no sample of a row can be predicted to be inside.
  bool is_beyond(int y) const { return y < rows_.first || y >= rows_.second; }

  Predicted at(int x, int y) const {
    const double depth = depth_inside(edges_, x, y);
    if (std::abs(depth) < margin_) return Predicted::open;
    return depth > 0 ? Predicted::inside : Predicted::outside;
  }

 private:
  Prediction(const FineTriangle& at, double margin)
      : edges_(edges_of(at)), rows_(lines_of(at)), margin_(margin) {}

  FineEdges edges_;
  std::pair<int, int> rows_;
  double margin_;
};

/// Calls `visit(triangle, rows)` for all triangles of which something is drawn.
template <typename Visit>
void for_each_drawn(const std::vector<FineDrawing>& drawings, const Visit& visit) {
  for (const FineDrawing& drawing : drawings) {
    for (std::size_t i = 0; i < drawing.triangles.size(); ++i) {
      if (is_empty(drawing.rows[i])) continue;
      visit(drawing.triangles[i], drawing.rows[i]);
    }
  }
}

Sureness of_samples() { return {"samples"}; }

/// Returns the placements without moves, the unturned one first.
std::vector<Placement> turns() {
  std::vector<Placement> all;
  for (int i = 0; i < 8; ++i) {
    Placement one;
    one.is_transposed = (i & 4) != 0;
    one.is_mirrored = (i & 2) != 0;
    one.is_upside_down = (i & 1) != 0;
    all.push_back(one);
  }
  return all;
}

/// Returns all moves and sizes of a turned placement, the simplest first.
std::vector<Placement> moves_of(const Placement& turn) {
  std::vector<std::pair<int, Placement>> all;
  for (int x = -kMostMoved; x <= kMostMoved; ++x) {
    for (int y = -kMostMoved; y <= kMostMoved; ++y) {
      for (int shrunk = 0; shrunk < 4; ++shrunk) {
        Placement one = turn;
        one.move_x = x;
        one.move_y = y;
        one.shrink_x = shrunk & 1;
        one.shrink_y = shrunk >> 1;
        all.emplace_back(std::abs(x) + std::abs(y) + one.shrink_x + one.shrink_y, one);
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Placement> ordered;
  ordered.reserve(all.size());
  for (const auto& [parts, one] : all) ordered.push_back(one);
  return ordered;
}

/// Returns the placement with the fewest samples against it; of equals, the first.
Placement best_of(const std::vector<FineDrawing>& drawings, const std::vector<Placement>& all,
                  double margin) {
  std::optional<std::pair<double, Placement>> best;
  for (const Placement& one : all) {
    const Sureness votes = votes_of(drawings, one, margin);
    const auto share = static_cast<double>(votes.against) /
                       static_cast<double>(std::max<std::uint64_t>(1, votes.in_favour));
    if (!best || share < best->first) best = {share, one};
  }
  return best->second;
}

}  // namespace

FineTriangle placed(const FineTriangle& triangle, const Placement& placement) {
  constexpr std::int64_t kWindow = kFineSide * kFinePixel;
  FineTriangle moved = triangle;
  if (placement.is_transposed) std::swap(moved.x, moved.y);
  for (std::size_t i = 0; i < 3; ++i) {
    if (placement.is_mirrored) moved.x[i] = kWindow - moved.x[i];
    if (placement.is_upside_down) moved.y[i] = kWindow - moved.y[i];
    moved.x[i] = moved.x[i] * (kFineSide - placement.shrink_x) / kFineSide;
    moved.y[i] = moved.y[i] * (kFineSide - placement.shrink_y) / kFineSide;
    moved.x[i] += placement.move_x * kFinePixel / 2;
    moved.y[i] += placement.move_y * kFinePixel / 2;
  }
  return moved;
}

bool is_sure(const Sureness& votes) {
  return votes.in_favour >= kFewestVotes && kFewAgainst * votes.against <= votes.in_favour;
}

Sureness votes_of(const std::vector<FineDrawing>& drawings, const Placement& placement,
                  double margin) {
  Sureness votes = of_samples();
  for_each_drawn(drawings, [&](const FineTriangle& triangle, const FineRows& rows) {
    const Prediction prediction(triangle, placement, margin);
    for (int y = 0; y < kFineSide; ++y) {
      if (rows[static_cast<std::size_t>(y)] == 0 && prediction.is_beyond(y)) continue;
      for (int x = 0; x < kFineSide; ++x) {
        const bool is_drawn = has(rows, x, y);
        const Predicted predicted = prediction.at(x, y);
        if (predicted == Predicted::open) {
          ++votes.undecided;
        } else if (is_drawn || predicted == Predicted::inside) {
          ++(is_drawn && predicted == Predicted::inside ? votes.in_favour : votes.against);
        }
      }
    }
  });
  return votes;
}

Sureness votes_between(const std::vector<FineDrawing>& drawings, const Placement& one,
                       const Placement& other, double margin) {
  Sureness votes = of_samples();
  for_each_drawn(drawings, [&](const FineTriangle& triangle, const FineRows& rows) {
    const Prediction by_one(triangle, one, margin);
    const Prediction by_other(triangle, other, margin);
    for (int y = 0; y < kFineSide; ++y) {
      if (by_one.is_beyond(y) && by_other.is_beyond(y)) continue;
      for (int x = 0; x < kFineSide; ++x) {
        const Predicted a = by_one.at(x, y);
        const Predicted b = by_other.at(x, y);
        if (a == b) continue;
        if (a == Predicted::open || b == Predicted::open) {
          ++votes.undecided;
        } else {
          const bool is_for_one = (a == Predicted::inside) == has(rows, x, y);
          ++(is_for_one ? votes.in_favour : votes.against);
        }
      }
    }
  });
  return votes;
}

std::optional<FoundPlacement> find_placement(const std::vector<FineDrawing>& drawings) {
  FoundPlacement found;
  const Placement turn = best_of(drawings, turns(), kTurnMargin);
  if (!is_sure(votes_of(drawings, turn, kTurnMargin))) return std::nullopt;
  if (turn.is_turned()) {
    found.turn = votes_between(drawings, turn, {}, kTurnMargin);
    if (!is_sure(found.turn)) return std::nullopt;
  }
  found.placement = turn;
  const Placement best = best_of(drawings, moves_of(turn), kFineMargin);
  if (!is_sure(votes_of(drawings, best, kFineMargin))) return found;
  found.is_fine = true;
  found.placement = best;
  Placement unmoved = best;
  unmoved.move_x = unmoved.move_y = 0;
  Placement whole = best;
  whole.shrink_x = whole.shrink_y = 0;
  if (best.is_moved()) found.move = votes_between(drawings, best, unmoved, kFineMargin);
  if (best.is_shrunk()) found.shrink = votes_between(drawings, best, whole, kFineMargin);
  // A part that few samples tell from a drawing without it is not proved.
  if (best.is_moved() && !is_sure(found.move)) found.placement = unmoved;
  if (best.is_shrunk() && !is_sure(found.shrink)) {
    found.placement.shrink_x = found.placement.shrink_y = 0;
  }
  return found;
}

}  // namespace rastercheck::properties
