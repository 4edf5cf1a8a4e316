#pragma once

// Draws a case's fragments in few draws: instead of drawing each triangle into a layer of its own,
// the fragment shader appends a record of each fragment to a buffer. The viewport stays the case's
// own, so each triangle is drawn exactly as in a layer.
//
// A driver may silently lose records, or draw different bits because the shader has side effects.
// So a few triangles of each draw also go into layers and are compared with their records. If any
// differ, all triangles of the draw go into layers. A law looks for such differences
// (properties/laws/ways_draw_the_same.cpp).

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends {

/// Number of 32-bit words at the start of a record: the triangle's number as a float (1 for the
/// first triangle of the draw); the pixel, x + 2^16 y; and the depth as a float, which rounding may
/// put beyond the depth range.
inline constexpr std::size_t kRecordHead = 3;

/// Where a record holds the values of the attributes.
struct RecordLayout {
  struct Value {
    std::size_t word = kRecordHead;
    std::size_t attribute = 0;  ///< index into the case's attributes
  };
  std::size_t words = kRecordHead;  ///< words per record
  std::vector<Value> values;

  /// Appends a four-component vector that holds these attributes.
  void add_vector(std::span<const std::size_t> attributes);
};

/// The operations of one driver that draw_appended() needs.
struct AppendingDriver {
  /// The most words of records that one draw has room for.
  std::size_t most_words = 0;

  /// Draws `count` triangles starting at `first`, writing records in the layout with index
  /// `layout`. Returns how many fragments tried to append a record; if more than `room`, some
  /// records were lost.
  std::function<Result<std::size_t>(std::size_t layout, std::size_t first, std::size_t count,
                                    std::size_t room)>
      draw;

  /// Returns the records, in any order, of the last draw that lost none.
  std::function<std::span<const std::uint32_t>()> records;

  /// Draws each triangle of a case into a layer of its own.
  std::function<Result<cases::Fragments>(const cases::Case& c)> draw_in_layers;
};

/// Says why the fragments of a case cannot be appended; empty if they can. Appending ignores a
/// depth test, depth clamping, a depth bias and unorm formats, which affect only what is stored,
/// and several samples would need more data per record.
std::string lacks_of_appending(const cases::Case& c);

/// Draws a case for which lacks_of_appending() returns nothing. The triangles are drawn once with
/// each layout (at least one), so that records stay short. A triangle goes into a layer if it has
/// more fragments than the buffer has room for, or a depth that is NaN or beyond the depth range,
/// since such a depth does not tell what a depth buffer holds. Calls `go_on` after each draw. Fails
/// if a record names no triangle of the case. Fragments may lie outside the target, because a
/// driver may draw there. Compares records with layers only if `is_checked`.
Result<cases::Fragments> draw_appended(const cases::Case& c, std::span<const RecordLayout> layouts,
                                       const AppendingDriver& driver, bool is_checked,
                                       const std::function<void()>& go_on);

}  // namespace rastercheck::backends
