#include "oracle/internal/diamond_exit.h"

#include <algorithm>
#include <utility>

namespace rastercheck::oracle {
namespace {

/// c_0 + c_1 ε + c_2 ε² for an infinitely small ε > 0; orders by c_0, then c_1, then c_2.
using Nearly = std::array<Field, 3>;

Nearly exactly(const Field& value) { return {value, Field(0), Field(0)}; }

/// The position of a line along x + y or x − y, in which a diamond is a square: from `begin` at
/// t = 0 with a change of `change` until t = 1, moved by −(c_1 ε + c_2 ε²).
struct Course {
  Field begin;
  Field change;
  Field c1;
  Field c2;

  /// The t at which the moved course is at `place`; change must not be 0.
  Nearly time_of(const Field& place) const {
    return {(place - begin) / change, c1 / change, c2 / change};
  }
  Nearly at(const Field& t) const { return {begin + t * change, -c1, -c2}; }
};

/// The courses of a line along x + y and x − y.
std::array<Course, 2> courses_of(const ExactPosition& from, const ExactPosition& to, bool is_d3d) {
  const Field dx = to[0] - from[0];
  const Field dy = to[1] - from[1];
  // Moves by (ε, ε²) or (ε², ε): their sum and their difference.
  const Field sign(is_d3d ? -1 : 1);
  return {Course{from[0] + from[1], dx + dy, Field(1), Field(1)},
          Course{from[0] - from[1], dx - dy, sign, -sign}};
}

/// The two ends of a diamond along x + y and x − y.
std::array<std::array<Field, 2>, 2> diamond_of(int x, int y) {
  const Field half(1, 2);
  const Field sum(x + y + 1);
  const Field difference(x - y);
  return {std::array{Field(sum - half), Field(sum + half)},
          std::array{Field(difference - half), Field(difference + half)}};
}

bool is_between(const Nearly& value, const std::array<Field, 2>& ends) {
  return exactly(ends[0]) < value && value < exactly(ends[1]);
}

bool holds_end(const std::array<Course, 2>& courses,
               const std::array<std::array<Field, 2>, 2>& diamond) {
  return is_between(courses[0].at(Field(1)), diamond[0]) &&
         is_between(courses[1].at(Field(1)), diamond[1]);
}

bool meets(const std::array<Course, 2>& courses,
           const std::array<std::array<Field, 2>, 2>& diamond) {
  Nearly after = exactly(Field(0));
  Nearly before = exactly(Field(1));
  for (std::size_t i = 0; i < 2; ++i) {
    const Course& course = courses[i];
    if (sign_of(course.change) == 0) {
      if (!is_between(course.at(Field(0)), diamond[i])) return false;
      continue;
    }
    Nearly enters = course.time_of(diamond[i][0]);
    Nearly leaves = course.time_of(diamond[i][1]);
    if (leaves < enters) std::swap(enters, leaves);
    after = std::max(after, enters);
    before = std::min(before, leaves);
  }
  return after < before;
}

/// True if a line from `from` to `to` goes exactly through the right corner of the pixel's diamond.
bool touches_right_corner(const ExactPosition& from, const ExactPosition& to, int x, int y) {
  const ExactPosition corner{Field(x + 1), Field(2 * y + 1, 2)};
  const Field dx = to[0] - from[0];
  const Field dy = to[1] - from[1];
  const Field across = dx * (corner[1] - from[1]) - dy * (corner[0] - from[0]);
  const Field along = dx * (corner[0] - from[0]) + dy * (corner[1] - from[1]);
  return sign_of(across) == 0 && sign_of(along) >= 0 && along <= dx * dx + dy * dy;
}

}  // namespace

bool exits_diamond(const ExactPosition& from, const ExactPosition& to, int x, int y, bool is_d3d) {
  if (from == to) return false;
  const std::array<Course, 2> courses = courses_of(from, to, is_d3d);
  const auto diamond = diamond_of(x, y);
  const bool is_y_major = magnitude(Field(to[1] - from[1])) > magnitude(Field(to[0] - from[0]));
  if (is_d3d && is_y_major) {
    const ExactPosition right{Field(x + 1), Field(2 * y + 1, 2)};
    if (to == right) return false;
    if (touches_right_corner(from, to, x, y)) return !holds_end(courses, diamond);
  }
  return meets(courses, diamond) && !holds_end(courses, diamond);
}

}  // namespace rastercheck::oracle
