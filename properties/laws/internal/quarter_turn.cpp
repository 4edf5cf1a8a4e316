#include "properties/laws/internal/quarter_turn.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "properties/exact_sum.h"
#include "properties/laws/internal/window_symmetry.h"

namespace rastercheck::properties {

using oracle::WindowAxis;

std::optional<QuarterTurn> quarter_turn_of(const cases::Case& c) {
  const auto samples =
      carried_samples(c.framebuffer.samples, [](const cases::SamplePosition& position) {
        return cases::SamplePosition{16 - position.y, position.x};
      });
  const std::optional<WindowSide> across = side_of(c.viewport.x, c.viewport.width);
  const std::optional<WindowSide> down = side_of(c.viewport.y, c.viewport.height);
  if (!samples || !across || !down) return std::nullopt;
  if (is_at_samples(WindowAxis::y, down->begin, c.framebuffer) ||
      is_at_samples(WindowAxis::y, down->end, c.framebuffer)) {
    return std::nullopt;
  }
  const std::optional<double> x = exact_sum(static_cast<double>(c.framebuffer.height), -down->end);
  if (!x || !is_float(*x) || !is_float(across->begin)) return std::nullopt;
  // u' = H − v and v' = u. So the turned clip x grows with −v, and the turned clip y grows with u
  // if window y grows with clip y.
  const bool is_d3d = c.rules == cases::Rules::d3d;
  QuarterTurn turn;
  turn.viewport = c.viewport;
  turn.viewport.x = static_cast<float>(*x);
  turn.viewport.y = static_cast<float>(across->begin);
  turn.viewport.width = static_cast<float>(down->size);
  turn.viewport.height = static_cast<float>(across->size);
  turn.samples = *samples;
  turn.negates_y = down->is_turned_round == is_d3d;
  turn.negates_x = across->is_turned_round != is_d3d;
  return turn;
}

cases::Case turned_window(const cases::Case& c, const QuarterTurn& turn) {
  cases::Case result = c;
  std::swap(result.framebuffer.width, result.framebuffer.height);
  result.viewport = turn.viewport;
  if (c.scissor) {
    const PixelSpan columns = scissor_columns(c);
    const PixelSpan rows = scissor_rows(c);
    const int height = c.framebuffer.height;
    result.scissor = rectangle({height - rows.last, height - rows.first}, columns);
  }
  return result;
}

cases::ClipVertex turned(const cases::ClipVertex& p, const QuarterTurn& turn) {
  return {turn.negates_y ? -p.y : p.y, turn.negates_x ? -p.x : p.x, p.z, p.w};
}

cases::ClipVertex turned_back(const cases::ClipVertex& p, const QuarterTurn& turn) {
  return {turn.negates_x ? -p.y : p.y, turn.negates_y ? -p.x : p.x, p.z, p.w};
}

cases::Fragments turned_back(const cases::Case& c, const cases::Fragments& drawn,
                             const QuarterTurn& turn) {
  constexpr std::uint16_t kNowhere = std::numeric_limits<std::uint16_t>::max();
  cases::Fragments result = drawn;
  result.derivatives.clear();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    // In the turned drawing, x = H − 1 − j and y = i.
    const bool is_inside = std::cmp_less(drawn.x[i], c.framebuffer.height);
    result.x[i] = drawn.y[i];
    result.y[i] =
        is_inside ? static_cast<std::uint16_t>(c.framebuffer.height - 1 - drawn.x[i]) : kNowhere;
    result.sample[i] = carried_back(turn.samples, drawn.sample[i]);
  }
  return result;
}

std::optional<cases::Contract> turned_back(const cases::Case& c, const cases::Contract& contract) {
  if (contract.sample_position) return std::nullopt;
  cases::Contract result = contract;
  const bool is_of_all_sides =
      contract.tie_rule == cases::TieRule::all || contract.tie_rule == cases::TieRule::none;
  if (!is_of_all_sides) result.tie_rule = cases::TieRule::unspecified;
  if (!contract.coverage) return result;
  const cases::Snapping& grid = *contract.coverage;
  const int height = c.framebuffer.height;
  if (!is_symmetric(grid) || !keeps_even_points(grid, height)) {
    return std::nullopt;
  }
  return with_origin_away(result, height);
}

std::string turned_note(const cases::Case& c, const records::Violation& violation) {
  return "drawn turned by a quarter, at pixel (" +
         std::to_string(c.framebuffer.height - 1 - static_cast<int>(violation.place.y)) + ", " +
         std::to_string(violation.place.x) + ")";
}

}  // namespace rastercheck::properties
