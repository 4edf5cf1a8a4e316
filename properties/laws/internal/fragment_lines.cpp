#include "properties/laws/internal/fragment_lines.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "properties/choices.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {
namespace {

struct Keyed {
  std::uint32_t triangle = 0;
  std::uint32_t sample = 0;
  int line = 0;
  LinePoint point;

  auto line_key() const { return std::tuple(triangle, sample, line); }
  auto key() const { return std::tuple(triangle, sample, line, point.at, point.fragment); }
};

int line_of(int x, int y, LineDirection direction) {
  switch (direction) {
    case LineDirection::row:
      return y;
    case LineDirection::column:
      return x;
    case LineDirection::falling_diagonal:
      return x - y;
    case LineDirection::rising_diagonal:
      break;
  }
  return x + y;
}

}  // namespace

LineDirection some_direction(const cases::Case& c) {
  return Choices(choices_of(c))
      .pick(std::array{LineDirection::row, LineDirection::column, LineDirection::falling_diagonal,
                       LineDirection::rising_diagonal});
}

std::string_view to_string(LineDirection direction) {
  constexpr std::array<std::string_view, 4> kWords{"row", "column", "diagonal", "diagonal"};
  return kWords[static_cast<std::size_t>(direction)];
}

void for_each_line(const cases::Case& c, const cases::Fragments& drawn, LineDirection direction,
                   const LineSink& see) {
  std::vector<Keyed> all;
  all.reserve(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const cases::SamplePlace place = drawn.place_of(i);
    if (!is_of_case(c, place)) continue;
    const auto x = static_cast<int>(place.x);
    const auto y = static_cast<int>(place.y);
    const int at = direction == LineDirection::column ? y : x;
    all.push_back({place.triangle, place.sample, line_of(x, y, direction), {i, at}});
  }
  const auto is_before = [](const Keyed& a, const Keyed& b) { return a.key() < b.key(); };
  std::sort(all.begin(), all.end(), is_before);
  std::vector<LinePoint> line;
  for (std::size_t i = 0; i < all.size(); ++i) {
    line.push_back(all[i].point);
    const bool is_last = i + 1 == all.size() || all[i + 1].line_key() != all[i].line_key();
    if (!is_last) continue;
    if (line.size() > 1) see(line);
    line.clear();
  }
}

}  // namespace rastercheck::properties
