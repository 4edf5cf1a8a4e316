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
std::array<Course, 2> courses_of(const ExactPosition& from, const ExactPosition& to) {
  const Field dx = to[0] - from[0];
  const Field dy = to[1] - from[1];
  // The sum and the difference of the moves by ε and ε².
  return {Course{from[0] + from[1], dx + dy, Field(1), Field(1)},
          Course{from[0] - from[1], dx - dy, Field(1), Field(-1)}};
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

// --- Direct3D ------------------------------------------------------------------------------------

/// True if Direct3D's diamond of a pixel has the point: the open diamond, its two lower edges with
/// the bottom corner (y is down) and, for lines that are longer along y, its right corner.
bool d3d_diamond_has(const ExactPosition& p, int x, int y, bool is_y_major) {
  const Field dx = p[0] - Field(2 * x + 1, 2);
  const Field dy = p[1] - Field(2 * y + 1, 2);
  const Field distance = magnitude(dx) + magnitude(dy);
  if (distance != Field(1, 2)) return distance < Field(1, 2);
  return sign_of(dy) > 0 || (is_y_major && sign_of(dy) == 0 && sign_of(dx) > 0);
}

/// The line meets the closed diamond from one t to another. If it meets the open one, then half-way
/// between them; if it only touches an edge, that has the same owner everywhere but at its corners.
bool d3d_diamond_meets(const ExactPosition& from, const ExactPosition& to, int x, int y,
                       bool is_y_major) {
  const auto diamond = diamond_of(x, y);
  const std::array<Field, 2> begin{from[0] + from[1], from[0] - from[1]};
  const std::array<Field, 2> end{to[0] + to[1], to[0] - to[1]};
  Field first(0);
  Field last(1);
  for (std::size_t i = 0; i < 2; ++i) {
    const Field change = end[i] - begin[i];
    if (sign_of(change) == 0) {
      if (begin[i] < diamond[i][0] || begin[i] > diamond[i][1]) return false;
      continue;
    }
    Field enters = (diamond[i][0] - begin[i]) / change;
    Field leaves = (diamond[i][1] - begin[i]) / change;
    if (leaves < enters) std::swap(enters, leaves);
    first = std::max(first, enters);
    last = std::min(last, leaves);
  }
  if (last < first) return false;
  const auto has = [&](const Field& t) {
    const ExactPosition p{from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
    return d3d_diamond_has(p, x, y, is_y_major);
  };
  return has(first) || has(last) || has((first + last) / Field(2));
}

}  // namespace

bool exits_diamond(const ExactPosition& from, const ExactPosition& to, int x, int y, bool is_d3d) {
  if (from == to) return false;
  if (is_d3d) {
    const bool is_y_major = magnitude(Field(to[1] - from[1])) > magnitude(Field(to[0] - from[0]));
    return d3d_diamond_meets(from, to, x, y, is_y_major) && !d3d_diamond_has(to, x, y, is_y_major);
  }
  const std::array<Course, 2> courses = courses_of(from, to);
  const auto diamond = diamond_of(x, y);
  return meets(courses, diamond) && !holds_end(courses, diamond);
}

}  // namespace rastercheck::oracle
