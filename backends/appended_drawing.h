#pragma once

// A case's fragments in few draws: instead of drawing each triangle into a layer of its own, the
// fragment shader appends a record of each fragment to a buffer. The viewport stays the case's own,
// so that each triangle is the one that a layer would show.
//
// A driver may lose records in silence, or draw other bits as its shader has side effects. Of each
// draw a few triangles are therefore drawn into layers, too, and held against their records; where
// these differ, all triangles of the draw go into layers. A law looks for such differences
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

/// Words of 32 bits that a record begins with: the number of its triangle as a float, 1 for the
/// first of the draw; its pixel, x + 2^16 y; its depth as a float, which may lie beyond the depth
/// range by what it was rounded.
inline constexpr std::size_t kRecordHead = 3;

/// Says where a record has the values of attributes.
struct RecordLayout {
  struct Value {
    std::size_t word = kRecordHead;
    std::size_t attribute = 0;  ///< index into the case's
  };
  std::size_t words = kRecordHead;  ///< of a record
  std::vector<Value> values;

  /// Appends a vector of four that has these attributes.
  void add_vector(std::span<const std::size_t> attributes);
};

/// Draws with one driver for draw_appended().
struct AppendingDriver {
  /// Words of records that one draw has room for at most.
  std::size_t most_words = 0;

  /// Draws `count` triangles from `first` on, by the layout of that index, and gives how many
  /// fragments appended a record or tried to: where these are more than `room`, some were lost.
  std::function<Result<std::size_t>(std::size_t layout, std::size_t first, std::size_t count,
                                    std::size_t room)>
      draw;

  /// Gives the records of the last draw that lost none, in any order.
  std::function<std::span<const std::uint32_t>()> records;

  /// Draws each triangle of a case into a layer of its own.
  std::function<Result<cases::Fragments>(const cases::Case& c)> draw_in_layers;
};

/// Says why the fragments of a case cannot be appended; empty where they can. A depth test has no
/// say in what a shader appends, nor has clamping, which is of what is stored; of several samples
/// records would have to say more.
std::string lacks_of_appending(const cases::Case& c);

/// Draws a case that lacks_of_appending() has nothing against. Its attributes come in as many draws
/// as there are layouts, one at least, whose records do not get longer. A triangle with more
/// fragments than there is room for is drawn into a layer, and so is one with a depth beyond the
/// range or that is no number, which says nothing of what a depth buffer holds. Calls `go_on` after
/// each draw. Fails where records are of no triangle of the case; a fragment may lie outside the
/// target, as a driver may draw there. Layers are looked at only if that `is_checked`.
Result<cases::Fragments> draw_appended(const cases::Case& c, std::span<const RecordLayout> layouts,
                                       const AppendingDriver& driver, bool is_checked,
                                       const std::function<void()>& go_on);

}  // namespace rastercheck::backends
