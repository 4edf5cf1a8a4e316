#pragma once

// The messages between RasterCheck and a program that draws: lines of JSON, each followed by arrays
// of little-endian 32-bit numbers (docs/exec-protocol.md).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cases/capabilities.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/contract_terms.h"
#include "cases/error.h"
#include "cases/fragment_collector.h"
#include "cases/names.h"

namespace rastercheck::backends {

/// The version of the protocol.
inline constexpr std::uint64_t kExecProtocol = 1;

/// The most bytes of a line, without its end.
inline constexpr std::size_t kLongestLine = 65536;

/// The arrays of a program's answers. Each enumerator after `triangle` adds one array to those of
/// the enumerator before it, except that `attributes` replaces the barycentrics.
enum class Gives {
  triangle,      ///< which triangle is seen
  depth,         ///< and its depth
  barycentrics,  ///< and the weights of its three vertices
  attributes,    ///< and its attributes
};
constexpr auto names_of(Gives /*type*/) {
  return std::to_array<std::string_view>({"triangle", "depth", "barycentrics", "attributes"});
}

/// A program's first line.
struct ProgramHello {
  std::string name;
  std::string version;
  Gives gives = Gives::attributes;
  bool has_shared_memory = false;
  cases::ContractTerms contract;
  cases::Capabilities limits;
  /// The features that a program is asked for only if it names them, because they are younger than
  /// the protocol: depth_bias and unorm_depth.
  std::vector<cases::Feature> draws = {};
};

/// RasterCheck's first line.
std::string our_hello();
/// The error has a reason for users and no file.
Result<ProgramHello> parse_hello(std::string_view line);

/// The contract that a program's hello means for a case.
///
/// If a program gives barycentrics, its bound for smooth values applies to these weights, treated
/// as attributes with the values (1, 0, 0), (0, 1, 0) and (0, 0, 1) at the vertices. Let each
/// weight be off by at most B ulp(1). A value r = Σ b_i r_i with |r_i| <= M is then off by at most
/// 3 B ulp(1) M, which is at most 6 B ulp(M), since ulp(M) > M ulp(1)/2. This holds for each term
/// of the bound, except that the range of a weight is 1 whatever the range of r is. Rounding to
/// float32 adds 1/2, and summing in double less than 2^-20.
cases::Contract contract_of(const ProgramHello& hello, const cases::Case& c);

/// A request for a drawing.
struct DrawMessage {
  std::string header;  ///< without the end of the line
  std::string arrays;
  std::uint64_t samples = 0;  ///< of the framebuffer
};

/// How a program with shared memory finds its arrays.
struct MemoryPlan {
  std::uint64_t size = 0;       ///< bytes to map
  std::uint64_t answer_at = 0;  ///< where the answer's arrays begin
};

/// Asks for one triangle, which is then the only one of the draw, or for all of a case without a
/// camera. `promised` is what the program promises about the case.
DrawMessage draw_message(const cases::Case& c, const cases::Contract& promised,
                         std::optional<std::uint32_t> triangle);
/// Adds to a message's header where its arrays are.
void add_memory(DrawMessage& message, const MemoryPlan& memory);

/// The first line of an answer.
struct AnswerHeader {
  enum class Status { ok, unsupported, failed };
  friend constexpr auto names_of(Status /*type*/) {
    return std::to_array<std::string_view>({"ok", "unsupported", "failed"});
  }
  Status status = Status::ok;
  std::string message;
  /// The pixels min_x <= x < max_x, min_y <= y < max_y.
  std::uint32_t min_x = 0;
  std::uint32_t min_y = 0;
  std::uint32_t max_x = 0;
  std::uint32_t max_y = 0;
  std::uint64_t bytes = 0;  ///< of the arrays

  std::uint64_t pixels() const { return std::uint64_t{max_x - min_x} * (max_y - min_y); }
};

/// The bytes of the arrays of `samples` samples of a case.
std::uint64_t answer_bytes(Gives gives, const cases::Case& c, std::uint64_t samples);

/// Fails if the line is no header, or if its numbers do not fit each other or the case. The error
/// has a reason for users and no file.
Result<AnswerHeader> parse_answer(std::string_view line, Gives gives, const cases::Case& c);

/// Adds an answer's fragments to those of a case. `arrays` must have header.bytes bytes. `triangle`
/// is the only triangle of the draw, if it was drawn alone. Returns an empty text, or what is
/// wrong.
std::string add_answer(const AnswerHeader& header, std::string_view arrays, Gives gives,
                       const cases::Case& c, std::optional<std::uint32_t> triangle,
                       cases::FragmentCollector& fragments);

}  // namespace rastercheck::backends
